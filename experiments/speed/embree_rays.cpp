#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <limits>
#include <memory>

#include "common/clock.h"
#include "speed/competitor.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization::experiments {
namespace {

class Scene {
 public:
  explicit Scene(const Shape& shape) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                static_cast<std::size_t>(shape.vertex_count())));
    for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
      for (int axis = 0; axis < 3; ++axis)
        vertices[3 * v + axis] = static_cast<float>(shape.vertices(v, axis));
    auto* triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                static_cast<std::size_t>(shape.triangle_count())));
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      for (int corner = 0; corner < 3; ++corner)
        triangles[3 * t + corner] = static_cast<unsigned>(shape.triangles(t, corner));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Distance along `direction` to the first surface, infinity if none.
  double first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(origin.x());
    hit.ray.org_y = static_cast<float>(origin.y());
    hit.ray.org_z = static_cast<float>(origin.z());
    hit.ray.dir_x = static_cast<float>(direction.x());
    hit.ray.dir_y = static_cast<float>(direction.y());
    hit.ray.dir_z = static_cast<float>(direction.z());
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0U;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &hit);
#endif
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity() : hit.ray.tfar;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

Competitor embree_rays(const Shape& shape, int resolution) {
  Competitor result;
  result.name = "Embree rays " + std::to_string(resolution);
  const double start = processor_now();
  const auto scene = std::make_shared<Scene>(shape);
  result.build_seconds = processor_now() - start;
  result.measure = [scene, &shape, resolution](const Direction& direction) {
    const Window window = window_around(shape, direction, resolution);
    const Frame frame = frame_of(direction);
    const Eigen::VectorXd heights = shape.vertices * frame.w;
    const double low = heights.minCoeff() - 1, high = heights.maxCoeff() + 1;
    double best = 0;
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i) {
        const Eigen::Vector2d sample = window.sample(i, j);
        const Eigen::Vector3d base = frame.u * sample.x() + frame.v * sample.y();
        const double down = scene->first_hit(base + high * frame.w, -frame.w);
        if (down == std::numeric_limits<double>::infinity()) continue;
        const double up = scene->first_hit(base + low * frame.w, frame.w);
        best = std::max(best, high - down - (low + up));
      }
    return best;
  };
  return result;
}

}  // namespace stackabilization::experiments
