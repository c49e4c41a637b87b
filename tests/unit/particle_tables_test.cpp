// SPDX-License-Identifier: MIT
// src/tables/particle_tables: tables of particles are made once, however many volumes ask for them,
// and are what they would be if each volume made its own.
#include "tables/particle_tables.hpp"

#include <gtest/gtest.h>

#include <memory_resource>

#include "frame/transport.hpp"

namespace {

using namespace welkin;

constexpr uint32_t FORM = 2;

Medium mediumOf(double asymmetry) {
  ParticleParams params;
  params.asymmetry = asymmetry;
  params.analytic = true;
  return makeMedium(ParticleType::HenyeyGreenstein, params, {0.9, 1, 1});
}

struct Shared {
  Medium medium;
  std::shared_ptr<MediumTables> tables = std::make_shared<MediumTables>();
};

void addField(VolumeState& volume, const Shared& shared, float extinction) {
  FieldState& field = volume.fields[volume.fieldCount++];
  field.medium = shared.medium;
  field.tables = shared.tables;
  field.extinctionScale = extinction;
  field.mean = 0.5;
  field.meanSquare = 0.25;
}

TEST(ParticleTables, AreMadeOnceForAllVolumesOfAMedium) {
  const Shared shared{mediumOf(0.85)};
  VolumeState first(std::pmr::get_default_resource());
  addField(first, shared, 0.01f);
  VolumeState second(std::pmr::get_default_resource());
  addField(second, shared, 0.012f);
  const TransportMedia one = transportMedia(first);
  const SourceRows* rows = &shared.tables->own.rows(*shared.medium.particle, FORM);
  EXPECT_EQ(shared.tables->own.made(), 4u) << "phase, the same turned, pairs and rows";
  const TransportMedia other = transportMedia(second);
  EXPECT_EQ(&shared.tables->own.rows(*shared.medium.particle, FORM), rows);
  EXPECT_EQ(shared.tables->own.made(), 4u);
  EXPECT_EQ(one.response, other.response);
  EXPECT_EQ(one.peak, other.peak);
}

TEST(ParticleTables, EachFormAndEachMediumHasItsOwn) {
  const Shared wide{mediumOf(0.2)};
  const Shared narrow{mediumOf(0.9)};
  for (uint32_t form = 0; form < SCATTERING_FORMS; ++form) {
    const SourceRows& rows = wide.tables->own.rows(*wide.medium.particle, form);
    EXPECT_EQ(wide.tables->own.made(), form + 1);
    EXPECT_NE(rows.logSource, narrow.tables->own.rows(*narrow.medium.particle, form).logSource);
  }
  EXPECT_EQ(wide.tables->own.rows(*wide.medium.particle, FORM).logSource,
            peakRows(wide.medium.particle->curve).logSource);
  // Diameters of a medium's droplets are particles of their own.
  EXPECT_EQ(wide.tables->nodes[0].made(), 0u);
}

// A mixture depends on shares of its volume; its parts do not.
TEST(ParticleTables, OfAMixtureTheMediasPartsAreShared) {
  const Shared wide{mediumOf(0.2)};
  const Shared narrow{mediumOf(0.9)};
  VolumeState both(std::pmr::get_default_resource());
  addField(both, wide, 0.01f);
  addField(both, narrow, 0.02f);
  const TransportMedia mixed = transportMedia(both);
  VolumeState again(std::pmr::get_default_resource());
  addField(again, wide, 0.02f);
  addField(again, narrow, 0.01f);
  const TransportMedia other = transportMedia(again);
  EXPECT_EQ(wide.tables->own.made(), 2u) << "phase, and the same turned";
  EXPECT_EQ(narrow.tables->own.made(), 2u);
  EXPECT_NE(mixed.response, other.response);
}

}  // namespace
