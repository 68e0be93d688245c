#include "reckon/render/canvas.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace reckon::render {
namespace {

constexpr int kMostGeoms = 4000;

constexpr float kHazeOfWater[] = {0.10F, 0.30F, 0.40F, 1.0F};

/// The model with what only pictures need: their size, light, and a haze of water.
std::unique_ptr<mjModel, void (*)(mjModel*)> Prepared(const mjModel& model, Medium medium,
                                                      int width, int height) {
  std::unique_ptr<mjModel, void (*)(mjModel*)> copy(mj_copyModel(nullptr, &model), mj_deleteModel);
  if (!copy) throw std::runtime_error("no memory for a picture");
  copy->vis.global.offwidth = width;
  copy->vis.global.offheight = height;
  copy->vis.quality.shadowsize = 2048;
  copy->vis.quality.offsamples = 4;
  if (medium == Medium::kWater) {  // distances in units of the extent
    std::copy(kHazeOfWater, kHazeOfWater + 4, copy->vis.rgba.fog);
    copy->stat.extent = 1.0;
    copy->vis.map.fogstart = 4.0F;
    copy->vis.map.fogend = 45.0F;
    copy->vis.map.znear = 0.05F;
    copy->vis.map.zfar = 200.0F;
  }
  copy->vis.headlight.ambient[0] = copy->vis.headlight.ambient[1] = 0.35F;
  copy->vis.headlight.ambient[2] = 0.4F;
  return copy;
}

}  // namespace

class Canvas::Impl {
 public:
  Impl(const mjModel& model, Medium medium, int width, int height)
      : model_(Prepared(model, medium, width, height)), width_(width), height_(height) {
    mjv_defaultScene(&scene_);
    mjv_makeScene(model_.get(), &scene_, kMostGeoms);
    scene_.flags[mjRND_FOG] = medium == Medium::kWater ? 1 : 0;
    mjr_defaultContext(&context_);
    mjr_makeContext(model_.get(), &context_, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &context_);
    if (context_.currentBuffer != mjFB_OFFSCREEN) {
      throw std::runtime_error("there is no off-screen buffer to draw into");
    }
  }
  ~Impl() {
    mjr_freeContext(&context_);
    mjv_freeScene(&scene_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Picture Draw(const mjData& data, const View& view, std::span<const Line> lines) {
    mjvOption option;
    mjv_defaultOption(&option);
    mjvCamera camera;
    mjv_defaultCamera(&camera);
    std::copy(view.target.begin(), view.target.end(), camera.lookat);
    camera.distance = view.distance_m;
    camera.azimuth = view.azimuth_deg;
    camera.elevation = view.elevation_deg;
    // MuJoCo takes the data as mutable and changes nothing that lasts.
    mjv_updateScene(model_.get(), const_cast<mjData*>(&data), &option, nullptr, &camera, mjCAT_ALL,
                    &scene_);
    for (const Line& line : lines) Add(line);
    const mjrRect viewport{0, 0, width_, height_};
    mjr_render(viewport, &scene_, &context_);
    Picture picture{width_, height_, {}};
    const auto row = 3 * static_cast<std::size_t>(width_);
    std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height_));
    mjr_readPixels(upside_down.data(), nullptr, viewport, &context_);
    for (int y = height_ - 1; y >= 0; --y) {
      const auto* begin = upside_down.data() + row * static_cast<std::size_t>(y);
      picture.rgb.insert(picture.rgb.end(), begin, begin + row);
    }
    return picture;
  }

 private:
  void Add(const Line& line) {
    if (scene_.ngeom >= scene_.maxgeom) return;
    mjvGeom* geom = &scene_.geoms[scene_.ngeom++];
    mjv_initGeom(geom, mjGEOM_CAPSULE, nullptr, nullptr, nullptr, line.colour.data());
    mjv_connector(geom, mjGEOM_CAPSULE, line.width_m, line.from.data(), line.to.data());
  }

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  mjvScene scene_;
  mjrContext context_;
  int width_, height_;
};

Canvas::Canvas(const mjModel& model, Medium medium, int width, int height)
    : impl_(std::make_unique<Impl>(model, medium, width, height)) {}
Canvas::~Canvas() = default;

Picture Canvas::Draw(const mjData& data, const View& view, std::span<const Line> lines) {
  return impl_->Draw(data, view, lines);
}

void WritePpm(const Picture& picture, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << picture.width << " " << picture.height << "\n255\n";
  file.write(reinterpret_cast<const char*>(picture.rgb.data()),
             static_cast<std::streamsize>(picture.rgb.size()));
  if (!file.flush()) throw std::runtime_error(path + ": can't be written");
}

}  // namespace reckon::render
