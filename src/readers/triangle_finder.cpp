#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <new>

#include "readers/readers.hpp"

namespace poise::readers {
namespace {

class Embree : public TriangleFinder {
 public:
  explicit Embree(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    // Single precision: as seen from the middle, in units of the size.
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    middle_ = box.center();
    size_ = std::max(box.diagonal().norm(), std::numeric_limits<double>::min());
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    auto* const triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    if (!vertices || !triangles) throw std::bad_alloc();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Eigen::Vector3f v = ((mesh.vertices[i] - middle_) / size_).cast<float>();
      std::copy(v.begin(), v.end(), vertices + 3 * i);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), triangles + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no ray slips through between triangles
    // By this thread alone: always the same tree. (The device's own threads=1 would hold for all
    // work of the process.)
    oneapi::tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
  }
  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  std::optional<int> first(const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction) const override {
    // It begins near the mesh, however far away that is.
    const Eigen::Vector3d far = (origin - middle_) / size_;
    const double skipped = std::max(-far.dot(direction) - 1, 0.0);
    const Eigen::Vector3d near = far + skipped * direction;
    if (!(near.squaredNorm() < 4)) return {};
    const Eigen::Vector3f from = near.cast<float>(), along = direction.cast<float>();
    RTCRayHit query{};
    query.ray.org_x = from.x();
    query.ray.org_y = from.y();
    query.ray.org_z = from.z();
    query.ray.dir_x = along.x();
    query.ray.dir_y = along.y();
    query.ray.dir_z = along.z();
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return static_cast<int>(query.hit.primID);
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double size_{1};
};

}  // namespace

std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& mesh) {
  return std::make_unique<Embree>(mesh);
}

}  // namespace poise::readers
