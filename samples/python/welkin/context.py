# SPDX-License-Identifier: MIT
"""Contexts with numpy arrays: the queries of the CPU, and pictures of a device of Welkin's own."""
import numpy as np

from .api import API_VERSION, check, constants, ffi, lib, make, make_preset


def doubles(values, shape):
    array = np.ascontiguousarray(values, dtype=np.float64)
    return np.broadcast_to(array, shape).copy() if array.shape != shape else array


def pointer(array, kind="double *"):
    return ffi.cast(kind, ffi.from_buffer(array))


class Context:
    """A context; `with` destroys it, and with it all that was made from it.

    headless=True renders on a device that Welkin makes (a CPU's, such as lavapipe, will do);
    otherwise there are only the queries, and no Vulkan.
    """

    def __init__(self, headless=False):
        info = make("WlkContextInfo")
        chained = make("WlkHeadlessInfo") if headless else ffi.NULL
        info.next = chained
        handle = ffi.new("WlkContext *")
        check(lib.wlkCreateContext(API_VERSION, info, handle))
        self.handle = handle[0]

    def close(self):
        lib.wlkDestroyContext(self.handle)
        self.handle = ffi.NULL

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __getattr__(self, name):
        """context.SetFog(fog) is wlkSetFog(context, fog), checked; so with every other function."""
        function = getattr(lib, "wlk" + name, None) if name[:1].isupper() else None
        if function is None:
            raise AttributeError(name)
        return lambda *arguments: check(function(self.handle, *arguments))

    # ------------------------------------------------------------------------------- the scene

    def set_atmosphere(self, preset):
        """One of WLK_ATMOSPHERE_*: planet, air, absorber and haze."""
        self.SetPlanet(make_preset(preset, "WlkPlanet"))
        self.SetSky(make_preset(preset, "WlkSky"))
        self.SetAbsorber(make_preset(preset, "WlkAbsorber"))
        haze = make_preset(preset, "WlkFog")
        haze.medium = self.create_medium(make_preset(preset, "WlkMediumInfo"))
        self.SetFog(haze)

    def set_lights(self, *lights):
        array = ffi.new("WlkLight[]", [light[0] for light in lights])
        self.SetLights(len(lights), ffi.sizeof("WlkLight"), array)

    def create_medium(self, info):
        medium = ffi.new("WlkMedium *")
        self.CreateMedium(info, medium)
        return medium[0]

    def create_volume(self, density, medium, extinction_scale, world_from_volume):
        """One field; density[z, y, x], at value 1 of extinction `extinction_scale` (1/m)."""
        density = np.ascontiguousarray(density, dtype=np.float32)
        size = density.shape[::-1]
        field = ffi.new("WlkVolumeField *", {"medium": medium, "extinctionScale": extinction_scale})
        info = make("WlkVolumeInfo", size=size, fieldCount=1, fields=field,
                    worldFromVolume=np.ravel(world_from_volume))
        volume = ffi.new("WlkVolume *")
        self.CreateVolume(info, volume)
        upload = make("WlkVolumeUpload", extent=size, data=pointer(density, "void *"),
                      dataSize=density.nbytes)
        self.UploadVolume(volume[0], upload)
        return volume[0]

    # ----------------------------------------------------------------------------- the queries

    def phase(self, medium, angle, order_kind=None, **fields):
        """Phase function, 1/sr: RGB for each scattering angle (rad). wlkEvalPhase."""
        angle = doubles(angle, np.shape(np.atleast_1d(angle)))
        result = np.empty((angle.size, 3))
        query = make("WlkPhaseQuery", medium=medium, count=angle.size,
                     scatteringAngle=pointer(angle),
                     orderKind=lib.WLK_ORDER_SINGLE if order_kind is None else order_kind, **fields)
        self.EvalPhase(query, pointer(result))
        return result.reshape(*angle.shape, 3)

    def sample_phase(self, medium, random, channel=1):
        """Scattering angles (rad) and their densities (1/sr) for random numbers in [0, 1)."""
        random = doubles(random, np.shape(np.atleast_1d(random)))
        angle, density = np.empty_like(random), np.empty_like(random)
        self.SamplePhase(medium, channel, random.size, pointer(random), pointer(angle),
                         pointer(density))
        return angle, density

    def sky(self, origin, direction, length=np.inf, max_order=0):
        """In-scattered radiance and transmittance along rays, RGB. wlkEvalSky.

        direction has the shape (..., 3); origin and length are broadcast to it.
        """
        direction = np.ascontiguousarray(direction, dtype=np.float64)
        count = direction.size // 3
        rays = np.empty((count, 7))
        rays[:, 0:3] = np.broadcast_to(origin, direction.shape).reshape(-1, 3)
        rays[:, 3:6] = direction.reshape(-1, 3)
        rays[:, 6] = np.broadcast_to(length, direction.shape[:-1]).ravel()
        radiance, transmittance = np.empty((count, 3)), np.empty((count, 3))
        batch = make("WlkRayBatch", count=count, rays=pointer(rays, "WlkRay *"), maxOrder=max_order)
        self.EvalSky(batch, pointer(radiance), pointer(transmittance))
        return radiance.reshape(direction.shape), transmittance.reshape(direction.shape)

    def transmittance(self, start, end):
        """RGB, between two world points. wlkEvalTransmittance."""
        result = np.empty(3)
        self.EvalTransmittance(pointer(doubles(start, (3,))), pointer(doubles(end, (3,))),
                               pointer(result))
        return result

    def light(self, position, index=0):
        """Irradiance of a light at a world point, RGB. wlkEvalLight."""
        result = np.empty(3)
        self.EvalLight(index, pointer(doubles(position, (3,))), pointer(result))
        return result

    def ambient(self, position):
        """Spherical harmonics of the light of sky and ground, (9, 3). wlkEvalAmbient."""
        result = np.empty((constants["WLK_AMBIENT_VALUES"] // 3, 3))
        self.EvalAmbient(pointer(doubles(position, (3,))), pointer(result))
        return result

    def irradiance(self, position, normal):
        """Irradiance of a surface by the lights and by sky and ground, RGB. wlkEvalIrradiance."""
        direct, diffuse = np.empty(3), np.empty(3)
        self.EvalIrradiance(pointer(doubles(position, (3,))), pointer(doubles(normal, (3,))),
                            pointer(direct), pointer(diffuse))
        return direct, diffuse

    def sky_map(self, position, size=32, max_order=0):
        """Octahedral map of radiance, (size, size, 3). wlkEvalSkyMap."""
        result = np.empty((size, size, 3), dtype=np.float32)
        query = make("WlkSkyMapQuery", position=position, size=size, maxOrder=max_order)
        self.EvalSkyMap(query, pointer(result, "float *"), result.nbytes)
        return result

    # ----------------------------------------------------------------------------- the picture

    def render(self, width, height, camera=None, quality=None, color=None, depth=None):
        """A picture, (height, width, 4) floats, top row first. Needs headless=True.

        `color` (height, width, 4) and `depth` (height, width) are what the engine drew.
        """
        view = ffi.new("WlkView *")
        self.CreateView(make("WlkViewInfo", width=width, height=height), view)
        try:
            self.SetCamera(view[0], camera if camera is not None else make("WlkCamera"))
            self.SetQuality(view[0], quality if quality is not None else make("WlkQuality"))
            self.Prepare()
            kept = []
            targets = make("WlkHeadlessInputs")
            for name, data, shape in (("color", color, (height, width, 4)),
                                      ("depth", depth, (height, width))):
                if data is not None:
                    kept.append(np.ascontiguousarray(data, dtype=np.float32))
                    if kept[-1].shape != shape:
                        raise ValueError(f"{name} has the shape {kept[-1].shape}, not {shape}")
                    setattr(targets, name, pointer(kept[-1], "float *"))
                    setattr(targets, name + "Size", kept[-1].nbytes)
            self.RenderHeadless(view[0], targets)
            picture = np.empty((height, width, 4), dtype=np.float32)
            image = make("WlkImageData", data=pointer(picture, "float *"), dataSize=picture.nbytes)
            self.Readback(view[0], image)
            return picture
        finally:
            self.DestroyView(view[0])
