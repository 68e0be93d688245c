#include "reckon/sim/scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reckon/sim/ground_geoms.h"

namespace reckon::sim {

void SetHardContact(mjsGeom* geom, double friction) {
  geom->condim = 3;
  geom->friction[0] = friction;
}

namespace {

constexpr double kOverhang = 2.0;  // m beyond the map, for beams that look outwards

mjsGeom* AddBottom(const Seabed& seabed, mjSpec* spec, mjsBody* world) {
  const Terrain& terrain = seabed.terrain();
  if (terrain.config().kind != TerrainKind::kRough) {
    return AddGroundPlane(world, terrain.At(0.0, 0.0), -seabed.Depth(0.0, 0.0), "sand");
  }
  const HeightSamples samples{terrain.config().half_size_m + kOverhang,
                              terrain.config().shortest_wave_m / 4.0,
                              [&terrain](double x, double y) { return terrain.At(x, y).h; }};
  return AddHeightfield(spec, world, "seabed", samples, -seabed.mean_depth_m(), "sand");
}

void AddFeature(const FeatureConfig& feature, const Seabed& seabed, mjsBody* world) {
  const auto& [x, y] = feature.at_m;
  const double bottom = -seabed.Depth(x, y);
  mjsGeom* geom = mjs_addGeom(world, nullptr);
  double* size = geom->size;
  for (int i = 0; i < 3; ++i) size[i] = feature.size_m[static_cast<std::size_t>(i)] / 2.0;
  const double half_yaw = feature.yaw_deg * std::numbers::pi / 360.0;
  const double yaw[4] = {std::cos(half_yaw), 0.0, 0.0, std::sin(half_yaw)};
  std::copy(yaw, yaw + 4, geom->quat);
  const float rock[] = {0.45F, 0.42F, 0.40F, 1.0F}, rust[] = {0.60F, 0.33F, 0.20F, 1.0F};
  const float* colour = feature.kind == FeatureKind::kPipe ? rust : rock;
  std::copy(colour, colour + 4, geom->rgba);
  switch (feature.kind) {
    case FeatureKind::kBoulder:
      geom->type = mjGEOM_ELLIPSOID;
      SetPosition(geom, x, y, bottom);
      break;
    case FeatureKind::kBlock:
      geom->type = mjGEOM_BOX;
      SetPosition(geom, x, y, bottom + size[2]);
      break;
    case FeatureKind::kPipe: {
      geom->type = mjGEOM_CYLINDER;
      SetPosition(geom, x, y, bottom + size[2]);
      const double lying[4] = {std::numbers::sqrt2 / 2, 0.0, std::numbers::sqrt2 / 2, 0.0};
      mju_mulQuat(geom->quat, yaw, lying);  // a cylinder's axis is its z
      size[1] = size[0];
      size[0] = size[2];
      break;
    }
  }
  SetHardContact(geom, seabed.terrain().config().friction);
}

}  // namespace

void AddSeabed(const Seabed& seabed, mjSpec* spec, mjsBody* world) {
  AddSky(spec, "haze", {0.20, 0.50, 0.62}, {0.10, 0.30, 0.40});
  AddChecker(spec, "sand", {0.76, 0.70, 0.52}, {0.68, 0.62, 0.45}, 1.0);
  SetHardContact(AddBottom(seabed, spec, world), seabed.terrain().config().friction);
  for (const FeatureConfig& feature : seabed.features()) AddFeature(feature, seabed, world);
}

std::optional<RayHit> Scenery::Cast(const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& direction) const {
  constexpr std::array<mjtByte, mjNGROUP> kSeen{1};  // kSceneryGroup
  int geom = -1;
  Eigen::Vector3d normal;
  const double range = mj_ray(model_, data_, from.data(), direction.data(), kSeen.data(), 1, -1,
                              &geom, normal.data());
  if (geom < 0) return std::nullopt;
  return RayHit{range, std::abs(direction.dot(normal))};
}

}  // namespace reckon::sim
