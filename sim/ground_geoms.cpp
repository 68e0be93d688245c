#include "reckon/sim/ground_geoms.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace reckon::sim {
namespace {

constexpr double kBasement = 1.0;                         // m under a heightfield's lowest node
constexpr double kLeastNodes = 2.0, kMostNodes = 2000.0;  // a side

/// Of two colours in a pattern that the engine knows.
void AddTexture(mjSpec* spec, const std::string& name, mjtTexture type, mjtBuiltin pattern,
                const double (&first)[3], const double (&second)[3]) {
  mjsTexture* texture = mjs_addTexture(spec, nullptr);
  mjs_setName(texture->element, name.c_str());
  texture->type = type;
  texture->builtin = pattern;
  texture->width = texture->height = 64;
  std::copy(first, first + 3, texture->rgb1);
  std::copy(second, second + 3, texture->rgb2);
}

}  // namespace

void SetPosition(mjsGeom* geom, double x, double y, double z) {
  geom->pos[0] = x;
  geom->pos[1] = y;
  geom->pos[2] = z;
}

mjsGeom* AddGroundPlane(mjsBody* world, const Ground& ground, double z,
                        const std::string& material) {
  mjsGeom* plane = mjs_addGeom(world, nullptr);
  plane->type = mjGEOM_PLANE;
  plane->size[2] = 1.0;  // the others stay 0: without an edge
  SetPosition(plane, 0.0, 0.0, z);
  const double normal[3] = {-ground.hx, -ground.hy, 1.0};
  mju_quatZ2Vec(plane->quat, normal);
  mjs_setString(plane->material, material.c_str());
  return plane;
}

mjsGeom* AddHeightfield(mjSpec* spec, mjsBody* world, const std::string& name,
                        const HeightSamples& samples, double z, const std::string& material) {
  const double half = samples.half_size_m;
  const double wanted = std::clamp(2.0 * half / samples.spacing_m, kLeastNodes, kMostNodes);
  const int nodes = static_cast<int>(std::ceil(wanted)) + 1;
  std::vector<float> heights;
  heights.reserve(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes));
  for (int row = 0; row < nodes; ++row) {
    for (int column = 0; column < nodes; ++column) {
      const double step = 2.0 * half / (nodes - 1);
      heights.push_back(
          static_cast<float>(samples.height(column * step - half, row * step - half)));
    }
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  mjsHField* field = mjs_addHField(spec);
  mjs_setName(field->element, name.c_str());
  field->nrow = field->ncol = nodes;
  // MuJoCo scales the nodes to [0, 1] and places the lowest at the geom's height.
  const double size[4] = {half, half, std::max(1e-6, static_cast<double>(*high - *low)), kBasement};
  std::copy(size, size + 4, field->size);
  mjsGeom* geom = mjs_addGeom(world, nullptr);
  geom->type = mjGEOM_HFIELD;
  mjs_setString(geom->hfieldname, name.c_str());
  mjs_setString(geom->material, material.c_str());
  SetPosition(geom, 0.0, 0.0, static_cast<double>(*low) + z);
  mjs_setFloat(field->userdata, heights.data(), static_cast<int>(heights.size()));
  return geom;
}

void AddChecker(mjSpec* spec, const std::string& name, const double (&light)[3],
                const double (&dark)[3], double square_m) {
  AddTexture(spec, name, mjTEXTURE_2D, mjBUILTIN_CHECKER, light, dark);
  mjsMaterial* material = mjs_addMaterial(spec, nullptr);
  mjs_setName(material->element, name.c_str());
  mjs_setInStringVec(material->textures, mjTEXROLE_RGB, name.c_str());
  material->texuniform = 1;
  material->texrepeat[0] = material->texrepeat[1] =
      static_cast<float>(0.5 / square_m);  // two squares a repeat
  material->specular = material->reflectance = 0.0F;
}

void AddSky(mjSpec* spec, const std::string& name, const double (&above)[3],
            const double (&level)[3]) {
  AddTexture(spec, name, mjTEXTURE_SKYBOX, mjBUILTIN_GRADIENT, above, level);
}

}  // namespace reckon::sim
