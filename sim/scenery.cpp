#include "reckon/sim/scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace reckon::sim {

void SetHardContact(mjsGeom* geom, double friction) {
  geom->condim = 3;
  geom->friction[0] = friction;
}

namespace {

constexpr double kBasement = 1.0;    // m: how far a heightfield reaches below its lowest node
constexpr double kOverhang = 2.0;    // m beyond the map, for beams that look outwards
constexpr double kLeastNodes = 2.0;  // a side
constexpr double kMostNodes = 2000.0;

void SetPosition(mjsGeom* geom, double x, double y, double z) {
  geom->pos[0] = x;
  geom->pos[1] = y;
  geom->pos[2] = z;
}

/// To be seen: the haze of water all around.
void AddHaze(mjSpec* spec) {
  mjsTexture* texture = mjs_addTexture(spec, nullptr);
  mjs_setName(texture->element, "haze");
  texture->type = mjTEXTURE_SKYBOX;
  texture->builtin = mjBUILTIN_GRADIENT;
  texture->width = texture->height = 64;
  const double above[] = {0.20, 0.50, 0.62}, level[] = {0.10, 0.30, 0.40};
  std::copy(above, above + 3, texture->rgb1);
  std::copy(level, level + 3, texture->rgb2);
}

/// To be seen: sand in squares of a metre.
void AddSand(mjSpec* spec) {
  mjsTexture* texture = mjs_addTexture(spec, nullptr);
  mjs_setName(texture->element, "sand");
  texture->type = mjTEXTURE_2D;
  texture->builtin = mjBUILTIN_CHECKER;
  texture->width = texture->height = 64;
  const double light[] = {0.76, 0.70, 0.52}, dark[] = {0.68, 0.62, 0.45};
  std::copy(light, light + 3, texture->rgb1);
  std::copy(dark, dark + 3, texture->rgb2);
  mjsMaterial* material = mjs_addMaterial(spec, nullptr);
  mjs_setName(material->element, "sand");
  mjs_setInStringVec(material->textures, mjTEXROLE_RGB, "sand");
  material->texuniform = 1;
  material->texrepeat[0] = material->texrepeat[1] = 0.5F;  // two squares a repeat
  material->specular = material->reflectance = 0.0F;
}

void AddPlane(const Seabed& seabed, mjsBody* world) {
  const Ground ground = seabed.terrain().At(0.0, 0.0);
  mjsGeom* plane = mjs_addGeom(world, nullptr);
  plane->type = mjGEOM_PLANE;
  plane->size[2] = 1.0;  // the others stay 0: without an edge
  SetPosition(plane, 0.0, 0.0, -seabed.Depth(0.0, 0.0));
  const double normal[3] = {-ground.hx, -ground.hy, 1.0};
  mju_quatZ2Vec(plane->quat, normal);
  mjs_setString(plane->material, "sand");
  SetHardContact(plane, seabed.terrain().config().friction);
}

void AddHeightfield(const Seabed& seabed, mjSpec* spec, mjsBody* world) {
  const double half = seabed.terrain().config().half_size_m + kOverhang;
  const double wanted = 2.0 * half / (seabed.terrain().config().shortest_wave_m / 4.0);
  const int nodes = static_cast<int>(std::ceil(std::clamp(wanted, kLeastNodes, kMostNodes))) + 1;
  std::vector<float> heights;
  heights.reserve(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes));
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) {
      const double step = 2.0 * half / (nodes - 1);
      heights.push_back(
          static_cast<float>(seabed.terrain().At(column * step - half, row * step - half).h));
    }
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  mjsHField* field = mjs_addHField(spec);
  mjs_setName(field->element, "seabed");
  field->nrow = field->ncol = nodes;
  // MuJoCo scales the nodes to [0, 1] and places the lowest at the geom's height.
  const double size[4] = {half, half, std::max(1e-6, static_cast<double>(*high - *low)), kBasement};
  std::copy(size, size + 4, field->size);
  mjsGeom* geom = mjs_addGeom(world, nullptr);
  geom->type = mjGEOM_HFIELD;
  mjs_setString(geom->hfieldname, "seabed");
  mjs_setString(geom->material, "sand");
  SetPosition(geom, 0.0, 0.0, static_cast<double>(*low) - seabed.mean_depth_m());
  SetHardContact(geom, seabed.terrain().config().friction);
  mjs_setFloat(field->userdata, heights.data(), static_cast<int>(heights.size()));
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
  AddHaze(spec);
  AddSand(spec);
  if (seabed.terrain().config().kind == TerrainKind::kRough) {
    AddHeightfield(seabed, spec, world);
  } else {
    AddPlane(seabed, world);
  }
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
