/* SPDX-License-Identifier: MIT
 *
 * Layout of the C API on x86-64: compiling this file is the test. Written by generate.py; a
 * difference here is an ABI break unless a structure only grew at its end.
 */
/* clang-format off */
#include <stddef.h>
#include <welkin/welkin_vulkan.h>

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), "size of " #type)
#define AT(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "::" #field)
#define STARTS(type) (offsetof(type, sType) == 0 && offsetof(type, structSize) == 4)
#define HEAD(type) _Static_assert(STARTS(type) && offsetof(type, next) == 8, "head of " #type)
#define VALUE(name, value) _Static_assert((long long)(name) == (value), #name)

SIZE(WlkErrorInfo, 352); HEAD(WlkErrorInfo);
AT(WlkErrorInfo, result, 16);
AT(WlkErrorInfo, structType, 20);
AT(WlkErrorInfo, vkResult, 24);
AT(WlkErrorInfo, reserved0, 28);
AT(WlkErrorInfo, field, 32);
AT(WlkErrorInfo, message, 96);

SIZE(WlkMedium, 8);
AT(WlkMedium, id, 0);

SIZE(WlkVolume, 8);
AT(WlkVolume, id, 0);

SIZE(WlkSurface, 8);
AT(WlkSurface, id, 0);

SIZE(WlkView, 8);
AT(WlkView, id, 0);

SIZE(WlkAllocator, 24);
AT(WlkAllocator, user, 0);
AT(WlkAllocator, allocate, 8);
AT(WlkAllocator, release, 16);

SIZE(WlkLogMessage, 32); HEAD(WlkLogMessage);
AT(WlkLogMessage, severity, 16);
AT(WlkLogMessage, id, 20);
AT(WlkLogMessage, text, 24);

SIZE(WlkContextInfo, 72); HEAD(WlkContextInfo);
AT(WlkContextInfo, maxFramesInFlight, 16);
AT(WlkContextInfo, reserved0, 20);
AT(WlkContextInfo, allocator, 24);
AT(WlkContextInfo, log, 48);
AT(WlkContextInfo, logUser, 56);
AT(WlkContextInfo, deviceMemoryLimit, 64);

SIZE(WlkHeadlessInfo, 32); HEAD(WlkHeadlessInfo);
AT(WlkHeadlessInfo, flags, 16);
AT(WlkHeadlessInfo, deviceName, 24);

SIZE(WlkCapabilities, 296); HEAD(WlkCapabilities);
AT(WlkCapabilities, mode, 16);
AT(WlkCapabilities, vulkanVersion, 20);
AT(WlkCapabilities, maxLights, 24);
AT(WlkCapabilities, maxVolumeSize, 28);
AT(WlkCapabilities, blendSupported, 32);
AT(WlkCapabilities, reserved0, 36);
AT(WlkCapabilities, deviceName, 40);

SIZE(WlkPlanet, 72); HEAD(WlkPlanet);
AT(WlkPlanet, seaLevelPoint, 16);
AT(WlkPlanet, up, 40);
AT(WlkPlanet, radius, 52);
AT(WlkPlanet, groundAlbedo, 56);
AT(WlkPlanet, reserved0, 68);

SIZE(WlkSky, 32); HEAD(WlkSky);
AT(WlkSky, rayleighScattering, 16);
AT(WlkSky, scaleHeight, 28);

SIZE(WlkAbsorber, 40); HEAD(WlkAbsorber);
AT(WlkAbsorber, absorption, 16);
AT(WlkAbsorber, peakAltitude, 28);
AT(WlkAbsorber, halfWidth, 32);
AT(WlkAbsorber, reserved0, 36);

SIZE(WlkLight, 72); HEAD(WlkLight);
AT(WlkLight, direction, 16);
AT(WlkLight, angularDiameter, 28);
AT(WlkLight, irradiance, 32);
AT(WlkLight, reserved0, 44);
AT(WlkLight, limbDarkening, 48);
AT(WlkLight, litFrom, 60);

SIZE(WlkAmbient, 160); HEAD(WlkAmbient);
AT(WlkAmbient, mode, 16);
AT(WlkAmbient, reserved0, 20);
AT(WlkAmbient, sky, 24);
AT(WlkAmbient, ground, 36);
AT(WlkAmbient, harmonics, 48);
AT(WlkAmbient, reserved1, 156);

SIZE(WlkFog, 56); HEAD(WlkFog);
AT(WlkFog, dropletDiameter_um, 16);
AT(WlkFog, extinction, 20);
AT(WlkFog, baseAltitude, 24);
AT(WlkFog, scaleHeight, 28);
AT(WlkFog, singleScatteringAlbedo, 32);
AT(WlkFog, phaseModel, 44);
AT(WlkFog, medium, 48);

SIZE(WlkMediumInfo, 80); HEAD(WlkMediumInfo);
AT(WlkMediumInfo, particle, 16);
AT(WlkMediumInfo, phaseModel, 20);
AT(WlkMediumInfo, diameter_um, 24);
AT(WlkMediumInfo, spread, 28);
AT(WlkMediumInfo, roughness, 32);
AT(WlkMediumInfo, asymmetry, 36);
AT(WlkMediumInfo, singleScatteringAlbedo, 40);
AT(WlkMediumInfo, wavelength_um, 52);
AT(WlkMediumInfo, userAngle, 56);
AT(WlkMediumInfo, userPhase, 64);
AT(WlkMediumInfo, userCount, 72);
AT(WlkMediumInfo, reserved0, 76);

SIZE(WlkMediumOptics, 96); HEAD(WlkMediumOptics);
AT(WlkMediumOptics, extinctionEfficiency, 16);
AT(WlkMediumOptics, effectiveRadius_um, 28);
AT(WlkMediumOptics, extinctionCrossSection, 32);
AT(WlkMediumOptics, asymmetry, 56);
AT(WlkMediumOptics, forwardFraction, 68);
AT(WlkMediumOptics, deltaFraction, 80);
AT(WlkMediumOptics, reserved0, 92);

SIZE(WlkVolumeField, 16);
AT(WlkVolumeField, medium, 0);
AT(WlkVolumeField, extinctionScale, 8);
AT(WlkVolumeField, reserved0, 12);

SIZE(WlkVolumeInfo, 144); HEAD(WlkVolumeInfo);
AT(WlkVolumeInfo, size, 16);
AT(WlkVolumeInfo, fieldCount, 28);
AT(WlkVolumeInfo, fieldStride, 32);
AT(WlkVolumeInfo, reserved0, 36);
AT(WlkVolumeInfo, fields, 40);
AT(WlkVolumeInfo, worldFromVolume, 48);

SIZE(WlkVolumeUpload, 80); HEAD(WlkVolumeUpload);
AT(WlkVolumeUpload, field, 16);
AT(WlkVolumeUpload, format, 20);
AT(WlkVolumeUpload, offset, 24);
AT(WlkVolumeUpload, extent, 36);
AT(WlkVolumeUpload, rowPitch, 48);
AT(WlkVolumeUpload, slicePitch, 56);
AT(WlkVolumeUpload, data, 64);
AT(WlkVolumeUpload, dataSize, 72);

SIZE(WlkVolumeBricks, 64); HEAD(WlkVolumeBricks);
AT(WlkVolumeBricks, field, 16);
AT(WlkVolumeBricks, format, 20);
AT(WlkVolumeBricks, count, 24);
AT(WlkVolumeBricks, reserved0, 28);
AT(WlkVolumeBricks, coordinates, 32);
AT(WlkVolumeBricks, data, 40);
AT(WlkVolumeBricks, brickPitch, 48);
AT(WlkVolumeBricks, dataSize, 56);

SIZE(WlkVolumeState, 72); HEAD(WlkVolumeState);
AT(WlkVolumeState, bricks, 16);
AT(WlkVolumeState, leaps, 28);
AT(WlkVolumeState, occupiedBricks, 32);
AT(WlkVolumeState, storedBricks, 40);
AT(WlkVolumeState, deviceMemory, 48);
AT(WlkVolumeState, hostMemory, 56);
AT(WlkVolumeState, pendingMemory, 64);

SIZE(WlkSurfaceInfo, 152); HEAD(WlkSurfaceInfo);
AT(WlkSurfaceInfo, medium, 16);
AT(WlkSurfaceInfo, extinction, 24);
AT(WlkSurfaceInfo, vertexCount, 28);
AT(WlkSurfaceInfo, vertexStride, 32);
AT(WlkSurfaceInfo, triangleCount, 36);
AT(WlkSurfaceInfo, positions, 40);
AT(WlkSurfaceInfo, indices, 48);
AT(WlkSurfaceInfo, worldFromSurface, 56);

SIZE(WlkSurfaceDetail, 40); HEAD(WlkSurfaceDetail);
AT(WlkSurfaceDetail, depth, 16);
AT(WlkSurfaceDetail, size, 20);
AT(WlkSurfaceDetail, softness, 24);
AT(WlkSurfaceDetail, offset, 28);

SIZE(WlkViewInfo, 48); HEAD(WlkViewInfo);
AT(WlkViewInfo, width, 16);
AT(WlkViewInfo, height, 20);
AT(WlkViewInfo, composite, 24);
AT(WlkViewInfo, targetFormat, 28);
AT(WlkViewInfo, layers, 32);
AT(WlkViewInfo, colorSpace, 40);
AT(WlkViewInfo, reserved0, 44);

SIZE(WlkCamera, 144); HEAD(WlkCamera);
AT(WlkCamera, position, 16);
AT(WlkCamera, viewFromWorld, 40);
AT(WlkCamera, preExposure, 76);
AT(WlkCamera, clipFromView, 80);

SIZE(WlkQuality, 80); HEAD(WlkQuality);
AT(WlkQuality, level, 16);
AT(WlkQuality, sliceCount, 20);
AT(WlkQuality, batchSize, 24);
AT(WlkQuality, lightBufferSize, 28);
AT(WlkQuality, slicing, 32);
AT(WlkQuality, scattering, 36);
AT(WlkQuality, flags, 40);
AT(WlkQuality, volumeCells, 48);
AT(WlkQuality, control, 52);
AT(WlkQuality, timeBudget_ms, 56);
AT(WlkQuality, errorTarget, 60);
AT(WlkQuality, lowestLevel, 64);
AT(WlkQuality, volumeResolution, 68);
AT(WlkQuality, lightFrames, 72);
AT(WlkQuality, reserved0, 76);

SIZE(WlkQualityState, 88); HEAD(WlkQualityState);
AT(WlkQualityState, control, 16);
AT(WlkQualityState, reason, 20);
AT(WlkQualityState, rung, 24);
AT(WlkQualityState, lowestRung, 28);
AT(WlkQualityState, highestRung, 32);
AT(WlkQualityState, sliceCount, 36);
AT(WlkQualityState, batchSize, 40);
AT(WlkQualityState, lightBufferSize, 44);
AT(WlkQualityState, volumeCells, 48);
AT(WlkQualityState, reserved0, 52);
AT(WlkQualityState, time_ms, 56);
AT(WlkQualityState, predictedTime_ms, 60);
AT(WlkQualityState, relativeError, 64);
AT(WlkQualityState, reserved1, 68);
AT(WlkQualityState, sinceFrame, 72);
AT(WlkQualityState, switches, 80);

SIZE(WlkFrameInfo, 32); HEAD(WlkFrameInfo);
AT(WlkFrameInfo, frameIndex, 16);
AT(WlkFrameInfo, completedFrameIndex, 24);

SIZE(WlkLightShadow, 312); HEAD(WlkLightShadow);
AT(WlkLightShadow, cascadeCount, 16);
AT(WlkLightShadow, light, 20);
AT(WlkLightShadow, origin, 24);
AT(WlkLightShadow, clipFromWorld, 48);
AT(WlkLightShadow, bias, 304);
AT(WlkLightShadow, reserved0, 308);

SIZE(WlkHeadlessInputs, 80); HEAD(WlkHeadlessInputs);
AT(WlkHeadlessInputs, color, 16);
AT(WlkHeadlessInputs, colorSize, 24);
AT(WlkHeadlessInputs, depth, 32);
AT(WlkHeadlessInputs, depthSize, 40);
AT(WlkHeadlessInputs, lightShadow, 48);
AT(WlkHeadlessInputs, shadowDepth, 56);
AT(WlkHeadlessInputs, shadowDepthSize, 64);
AT(WlkHeadlessInputs, shadowWidth, 72);
AT(WlkHeadlessInputs, shadowHeight, 76);

SIZE(WlkImageData, 40); HEAD(WlkImageData);
AT(WlkImageData, image, 16);
AT(WlkImageData, reserved0, 20);
AT(WlkImageData, data, 24);
AT(WlkImageData, dataSize, 32);

SIZE(WlkAerialPerspective, 40); HEAD(WlkAerialPerspective);
AT(WlkAerialPerspective, width, 16);
AT(WlkAerialPerspective, height, 20);
AT(WlkAerialPerspective, depth, 24);
AT(WlkAerialPerspective, exponent, 28);
AT(WlkAerialPerspective, distance, 32);
AT(WlkAerialPerspective, reserved0, 36);

SIZE(WlkCloudShadow, 8);
AT(WlkCloudShadow, id, 0);

SIZE(WlkCloudShadowInfo, 80); HEAD(WlkCloudShadowInfo);
AT(WlkCloudShadowInfo, width, 16);
AT(WlkCloudShadowInfo, height, 20);
AT(WlkCloudShadowInfo, content, 24);
AT(WlkCloudShadowInfo, light, 28);
AT(WlkCloudShadowInfo, center, 32);
AT(WlkCloudShadowInfo, extent, 56);
AT(WlkCloudShadowInfo, maxSamples, 72);
AT(WlkCloudShadowInfo, reserved0, 76);

SIZE(WlkCloudShadowState, 160); HEAD(WlkCloudShadowState);
AT(WlkCloudShadowState, frameIndex, 16);
AT(WlkCloudShadowState, mapFromWorld, 24);
AT(WlkCloudShadowState, volumes, 120);
AT(WlkCloudShadowState, barriers, 124);
AT(WlkCloudShadowState, descriptorWrites, 128);
AT(WlkCloudShadowState, recorded, 132);
AT(WlkCloudShadowState, reason, 136);
AT(WlkCloudShadowState, commands, 140);
AT(WlkCloudShadowState, invocations, 144);
AT(WlkCloudShadowState, gpuTime_ns, 152);

SIZE(WlkPassStats, 112);
AT(WlkPassStats, name, 0);
AT(WlkPassStats, pass, 64);
AT(WlkPassStats, recorded, 68);
AT(WlkPassStats, reason, 72);
AT(WlkPassStats, commands, 76);
AT(WlkPassStats, volume, 80);
AT(WlkPassStats, surface, 88);
AT(WlkPassStats, invocations, 96);
AT(WlkPassStats, gpuTime_ns, 104);

SIZE(WlkFrameStats, 72); HEAD(WlkFrameStats);
AT(WlkFrameStats, frameIndex, 16);
AT(WlkFrameStats, dispatches, 24);
AT(WlkFrameStats, draws, 28);
AT(WlkFrameStats, barriers, 32);
AT(WlkFrameStats, descriptorWrites, 36);
AT(WlkFrameStats, bytesUploaded, 40);
AT(WlkFrameStats, deviceMemory, 48);
AT(WlkFrameStats, hostMemory, 56);
AT(WlkFrameStats, nonFinitePixels, 64);

SIZE(WlkErrorEstimate, 56); HEAD(WlkErrorEstimate);
AT(WlkErrorEstimate, relativeError, 16);
AT(WlkErrorEstimate, dominant, 20);
AT(WlkErrorEstimate, part, 24);

SIZE(WlkRay, 56);
AT(WlkRay, origin, 0);
AT(WlkRay, direction, 24);
AT(WlkRay, length, 48);

SIZE(WlkRayBatch, 40); HEAD(WlkRayBatch);
AT(WlkRayBatch, count, 16);
AT(WlkRayBatch, stride, 20);
AT(WlkRayBatch, rays, 24);
AT(WlkRayBatch, maxOrder, 32);
AT(WlkRayBatch, reserved0, 36);

SIZE(WlkSkyMapQuery, 48); HEAD(WlkSkyMapQuery);
AT(WlkSkyMapQuery, position, 16);
AT(WlkSkyMapQuery, size, 40);
AT(WlkSkyMapQuery, maxOrder, 44);

SIZE(WlkPhaseQuery, 56); HEAD(WlkPhaseQuery);
AT(WlkPhaseQuery, medium, 16);
AT(WlkPhaseQuery, orderKind, 24);
AT(WlkPhaseQuery, order, 28);
AT(WlkPhaseQuery, opticalDepth, 32);
AT(WlkPhaseQuery, count, 40);
AT(WlkPhaseQuery, reserved0, 44);
AT(WlkPhaseQuery, scatteringAngle, 48);

SIZE(WlkVulkanRequirements, 72); HEAD(WlkVulkanRequirements);
AT(WlkVulkanRequirements, apiVersion, 16);
AT(WlkVulkanRequirements, queueFlags, 20);
AT(WlkVulkanRequirements, synchronization2, 24);
AT(WlkVulkanRequirements, dynamicRendering, 28);
AT(WlkVulkanRequirements, shaderStorageImageWriteWithoutFormat, 32);
AT(WlkVulkanRequirements, dualSrcBlend, 36);
AT(WlkVulkanRequirements, fragmentStoresAndAtomics, 40);
AT(WlkVulkanRequirements, depthUsage, 44);
AT(WlkVulkanRequirements, colorInputUsage, 48);
AT(WlkVulkanRequirements, storageTargetUsage, 52);
AT(WlkVulkanRequirements, blendTargetUsage, 56);
AT(WlkVulkanRequirements, volumeUsage, 60);
AT(WlkVulkanRequirements, reserved0, 64);

SIZE(WlkVulkanDeviceInfo, 72); HEAD(WlkVulkanDeviceInfo);
AT(WlkVulkanDeviceInfo, getInstanceProcAddr, 16);
AT(WlkVulkanDeviceInfo, instance, 24);
AT(WlkVulkanDeviceInfo, physicalDevice, 32);
AT(WlkVulkanDeviceInfo, device, 40);
AT(WlkVulkanDeviceInfo, apiVersion, 48);
AT(WlkVulkanDeviceInfo, queueFamilyIndex, 52);
AT(WlkVulkanDeviceInfo, enabledFeatures, 56);
AT(WlkVulkanDeviceInfo, pipelineCache, 64);

SIZE(WlkVulkanImageState, 24);
AT(WlkVulkanImageState, layout, 0);
AT(WlkVulkanImageState, reserved0, 4);
AT(WlkVulkanImageState, stages, 8);
AT(WlkVulkanImageState, access, 16);

SIZE(WlkVulkanImage, 104); HEAD(WlkVulkanImage);
AT(WlkVulkanImage, image, 16);
AT(WlkVulkanImage, format, 24);
AT(WlkVulkanImage, width, 28);
AT(WlkVulkanImage, height, 32);
AT(WlkVulkanImage, depth, 36);
AT(WlkVulkanImage, mipLevel, 40);
AT(WlkVulkanImage, baseArrayLayer, 44);
AT(WlkVulkanImage, layerCount, 48);
AT(WlkVulkanImage, reserved0, 52);
AT(WlkVulkanImage, before, 56);
AT(WlkVulkanImage, after, 80);

SIZE(WlkVulkanViewTargets, 96); HEAD(WlkVulkanViewTargets);
AT(WlkVulkanViewTargets, depth, 16);
AT(WlkVulkanViewTargets, colorInput, 24);
AT(WlkVulkanViewTargets, color, 32);
AT(WlkVulkanViewTargets, radiance, 40);
AT(WlkVulkanViewTargets, transmittance, 48);
AT(WlkVulkanViewTargets, lightShadow, 56);
AT(WlkVulkanViewTargets, shadowMap, 64);
AT(WlkVulkanViewTargets, aerialRadiance, 72);
AT(WlkVulkanViewTargets, aerialTransmittance, 80);
AT(WlkVulkanViewTargets, volumeDistance, 88);

VALUE(WLK_SUCCESS, 0); VALUE(WLK_NOT_READY, 1); VALUE(WLK_INCOMPLETE, 2);
VALUE(WLK_ERROR_INVALID_ARGUMENT, -1); VALUE(WLK_ERROR_INVALID_HANDLE, -2);
VALUE(WLK_ERROR_UNKNOWN_STRUCT, -3); VALUE(WLK_ERROR_STRUCT_TOO_NEW, -4);
VALUE(WLK_ERROR_VERSION, -5); VALUE(WLK_ERROR_OUT_OF_HOST_MEMORY, -6);
VALUE(WLK_ERROR_OUT_OF_DEVICE_MEMORY, -7); VALUE(WLK_ERROR_DEVICE_LOST, -8);
VALUE(WLK_ERROR_UNSUPPORTED_FORMAT, -9); VALUE(WLK_ERROR_MISSING_FEATURE, -10);
VALUE(WLK_ERROR_FRAMES_IN_FLIGHT, -11); VALUE(WLK_ERROR_NOT_PREPARED, -12);
VALUE(WLK_ERROR_WRONG_STATE, -13); VALUE(WLK_ERROR_LIMIT_EXCEEDED, -14);
VALUE(WLK_ERROR_NO_DEVICE, -15); VALUE(WLK_ERROR_INTERNAL, -16); VALUE(WLK_STRUCT_ERROR_INFO, 1);
VALUE(WLK_STRUCT_CONTEXT_INFO, 2); VALUE(WLK_STRUCT_HEADLESS_INFO, 3);
VALUE(WLK_STRUCT_CAPABILITIES, 4); VALUE(WLK_STRUCT_LOG_MESSAGE, 5); VALUE(WLK_STRUCT_PLANET, 10);
VALUE(WLK_STRUCT_SKY, 11); VALUE(WLK_STRUCT_LIGHT, 12); VALUE(WLK_STRUCT_FOG, 13);
VALUE(WLK_STRUCT_ABSORBER, 14); VALUE(WLK_STRUCT_AMBIENT, 16); VALUE(WLK_STRUCT_MEDIUM_INFO, 20);
VALUE(WLK_STRUCT_VOLUME_INFO, 21); VALUE(WLK_STRUCT_VOLUME_UPLOAD, 22);
VALUE(WLK_STRUCT_MEDIUM_OPTICS, 23); VALUE(WLK_STRUCT_VOLUME_BRICKS, 24);
VALUE(WLK_STRUCT_VOLUME_STATE, 25); VALUE(WLK_STRUCT_SURFACE_INFO, 26);
VALUE(WLK_STRUCT_SURFACE_DETAIL, 27); VALUE(WLK_STRUCT_VIEW_INFO, 30); VALUE(WLK_STRUCT_CAMERA, 31);
VALUE(WLK_STRUCT_QUALITY, 32); VALUE(WLK_STRUCT_QUALITY_STATE, 33);
VALUE(WLK_STRUCT_AERIAL_PERSPECTIVE, 34); VALUE(WLK_STRUCT_CLOUD_SHADOW_INFO, 35);
VALUE(WLK_STRUCT_CLOUD_SHADOW_STATE, 36); VALUE(WLK_STRUCT_FRAME_INFO, 40);
VALUE(WLK_STRUCT_HEADLESS_INPUTS, 41); VALUE(WLK_STRUCT_IMAGE_DATA, 42);
VALUE(WLK_STRUCT_FRAME_STATS, 43); VALUE(WLK_STRUCT_ERROR_ESTIMATE, 44);
VALUE(WLK_STRUCT_LIGHT_SHADOW, 47); VALUE(WLK_STRUCT_RAY_BATCH, 50);
VALUE(WLK_STRUCT_PHASE_QUERY, 51); VALUE(WLK_STRUCT_SKY_MAP_QUERY, 52);
VALUE(WLK_STRUCT_VULKAN_DEVICE_INFO, 1000); VALUE(WLK_STRUCT_VULKAN_REQUIREMENTS, 1001);
VALUE(WLK_STRUCT_VULKAN_IMAGE, 1002); VALUE(WLK_STRUCT_VULKAN_VIEW_TARGETS, 1003);
VALUE(WLK_LOG_ERROR, 1); VALUE(WLK_LOG_WARNING, 2); VALUE(WLK_LOG_INFO, 3);
VALUE(WLK_LOG_ID_VALIDATION, 1); VALUE(WLK_LOG_ID_VALUES_REPLACED, 2);
VALUE(WLK_LOG_ID_SHADOW_MAP_UNUSED, 3); VALUE(WLK_LOG_ID_PREPARED, 4);
VALUE(WLK_HEADLESS_VALIDATION, 1); VALUE(WLK_MODE_CPU, 0); VALUE(WLK_MODE_HEADLESS, 1);
VALUE(WLK_MODE_ENGINE_DEVICE, 2); VALUE(WLK_AMBIENT_OFF, 0); VALUE(WLK_AMBIENT_AUTOMATIC, 1);
VALUE(WLK_AMBIENT_GIVEN, 2); VALUE(WLK_PHASE_DEFAULT, 0); VALUE(WLK_PHASE_ANALYTIC, 1);
VALUE(WLK_PHASE_TABLE, 2); VALUE(WLK_PARTICLE_CLOUD, 0); VALUE(WLK_PARTICLE_FOG, 1);
VALUE(WLK_PARTICLE_HAZE, 2); VALUE(WLK_PARTICLE_RAIN, 3); VALUE(WLK_PARTICLE_ICE_COLUMN, 4);
VALUE(WLK_PARTICLE_ICE_PLATE, 5); VALUE(WLK_PARTICLE_SNOW, 6); VALUE(WLK_PARTICLE_AIR, 7);
VALUE(WLK_PARTICLE_HENYEY_GREENSTEIN, 8); VALUE(WLK_PARTICLE_USER, 9);
VALUE(WLK_ATMOSPHERE_EARTH_CLEAR, 0); VALUE(WLK_ATMOSPHERE_EARTH_HAZY, 1);
VALUE(WLK_ATMOSPHERE_EARTH_POLLUTED, 2); VALUE(WLK_ATMOSPHERE_MARS, 3);
VALUE(WLK_FORMAT_R32_FLOAT, 1); VALUE(WLK_FORMAT_R16_FLOAT, 2); VALUE(WLK_FORMAT_R8_UNORM, 3);
VALUE(WLK_COMPOSITE_COMPUTE, 0); VALUE(WLK_COMPOSITE_BLEND, 1); VALUE(WLK_COMPOSITE_SEPARATE, 2);
VALUE(WLK_LAYER_SKY, 1); VALUE(WLK_LAYER_FOG, 2); VALUE(WLK_LAYER_VOLUMES, 4);
VALUE(WLK_LAYER_SUN_DISK, 8); VALUE(WLK_LAYER_GROUND, 16); VALUE(WLK_LAYER_SURFACES, 32);
VALUE(WLK_LAYER_ALL, 2147483647); VALUE(WLK_TARGET_RGBA16_FLOAT, 1);
VALUE(WLK_TARGET_RGBA32_FLOAT, 2); VALUE(WLK_TARGET_B10G11R11_FLOAT, 3);
VALUE(WLK_COLOR_WAVELENGTHS, 0); VALUE(WLK_COLOR_LINEAR_SRGB, 1); VALUE(WLK_QUALITY_LOW, 0);
VALUE(WLK_QUALITY_MEDIUM, 1); VALUE(WLK_QUALITY_HIGH, 2); VALUE(WLK_QUALITY_ULTRA, 3);
VALUE(WLK_SLICING_DEFAULT, 0); VALUE(WLK_SLICING_HALF_ANGLE, 1);
VALUE(WLK_SLICING_LIGHT_ALIGNED, 2); VALUE(WLK_SCATTERING_DEFAULT, 0);
VALUE(WLK_SCATTERING_SINGLE, 1); VALUE(WLK_SCATTERING_FORWARD, 2);
VALUE(WLK_SCATTERING_FORWARD_INTEGER, 3); VALUE(WLK_SCATTERING_ALL_ORDERS, 4);
VALUE(WLK_QUALITY_FLAG_NO_SKIP, 1); VALUE(WLK_QUALITY_FLAG_VOLUME_SHADOWS, 2);
VALUE(WLK_QUALITY_FLAG_LIGHT_SHADOWS, 4); VALUE(WLK_VOLUME_RESOLUTION_DEFAULT, 0);
VALUE(WLK_VOLUME_RESOLUTION_FULL, 1); VALUE(WLK_VOLUME_RESOLUTION_HALF, 2);
VALUE(WLK_CONTROL_LEVEL, 0); VALUE(WLK_CONTROL_TIME, 1); VALUE(WLK_CONTROL_REPORTED_TIME, 2);
VALUE(WLK_CONTROL_ERROR, 3); VALUE(WLK_CONTROL_REASON_NONE, 0);
VALUE(WLK_CONTROL_REASON_MEASURING, 1); VALUE(WLK_CONTROL_REASON_FITS, 2);
VALUE(WLK_CONTROL_REASON_BEST, 3); VALUE(WLK_CONTROL_REASON_RISING, 4);
VALUE(WLK_CONTROL_REASON_OVER, 5); VALUE(WLK_CONTROL_REASON_UNREACHABLE, 6);
VALUE(WLK_CONTROL_REASON_IDLE, 7); VALUE(WLK_IMAGE_COLOR, 0); VALUE(WLK_IMAGE_RADIANCE, 1);
VALUE(WLK_IMAGE_TRANSMITTANCE, 2); VALUE(WLK_CLOUD_SHADOW_OPTICAL_DEPTH, 0);
VALUE(WLK_CLOUD_SHADOW_TRANSMITTANCE, 1); VALUE(WLK_CLOUD_SHADOW_LAYER, 2);
VALUE(WLK_PASS_LIGHT_SLICES, 1); VALUE(WLK_PASS_EYE_SLICES, 2); VALUE(WLK_PASS_COMPOSITE, 3);
VALUE(WLK_PASS_SKY_TABLE, 4); VALUE(WLK_PASS_VOLUME_LIGHT, 5); VALUE(WLK_PASS_CLOUD_SHADOW, 6);
VALUE(WLK_PASS_VOLUME_AMBIENT, 7); VALUE(WLK_PASS_AERIAL_PERSPECTIVE, 8);
VALUE(WLK_PASS_VOLUME_DISTANCE, 9); VALUE(WLK_PASS_SURFACE_LIGHT, 10); VALUE(WLK_PASS_SURFACE, 11);
VALUE(WLK_REASON_NEEDED, 0); VALUE(WLK_REASON_LAYER_OFF, 1); VALUE(WLK_REASON_NOTHING_TO_DRAW, 2);
VALUE(WLK_REASON_ZERO_DENSITY, 3); VALUE(WLK_REASON_OUTSIDE_VIEW, 4); VALUE(WLK_REASON_NO_LIGHT, 5);
VALUE(WLK_REASON_NO_SKIP_FLAG, 6); VALUE(WLK_REASON_UNCHANGED, 7); VALUE(WLK_REASON_SPREAD, 8);
VALUE(WLK_APPROXIMATION_SKY, 0); VALUE(WLK_APPROXIMATION_FOG, 1);
VALUE(WLK_APPROXIMATION_VOLUME_SCATTERING, 2); VALUE(WLK_APPROXIMATION_VOLUME_SLICES, 3);
VALUE(WLK_ORDER_SINGLE, 0); VALUE(WLK_ORDER_INTEGER, 1); VALUE(WLK_ORDER_POISSON, 2);
VALUE(WLK_VULKAN_FEATURE_BLEND, 1); VALUE(WLK_VERSION_MAJOR, 1); VALUE(WLK_VERSION_MINOR, 0);
VALUE(WLK_VERSION_PATCH, 0); VALUE(WLK_MAX_FIELDS, 4); VALUE(WLK_NAME_SIZE, 64);
VALUE(WLK_MESSAGE_SIZE, 256); VALUE(WLK_AMBIENT_VALUES, 27); VALUE(WLK_MAX_SHADOW_CASCADES, 4);
VALUE(WLK_MAX_APPROXIMATIONS, 8);
