#include "rays/ray_scene.h"

#include <embree3/rtcore.h>
#include <limits>

#include <algorithm>
#include <atomic>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {

static_assert(sizeof(RayPacket) == sizeof(RTCRayHit16) && alignof(RayPacket) >= 64);
static_assert(offsetof(RayPacket, direction_x) == offsetof(RTCRayHit16, ray.dir_x));
static_assert(offsetof(RayPacket, far) == offsetof(RTCRayHit16, ray.tfar));
static_assert(offsetof(RayPacket, normal_x) == offsetof(RTCRayHit16, hit.Ng_x));
static_assert(offsetof(RayPacket, u) == offsetof(RTCRayHit16, hit.u));
static_assert(offsetof(RayPacket, triangle) == offsetof(RTCRayHit16, hit.primID));
static_assert(offsetof(RayPacket, instance) == offsetof(RTCRayHit16, hit.instID));
static_assert(offsetof(NearTriangle, ball) == offsetof(RTCPointQueryFunctionArguments, query));
static_assert(offsetof(NearTriangle, user) == offsetof(RTCPointQueryFunctionArguments, userPtr));
static_assert(offsetof(NearTriangle, triangle) == offsetof(RTCPointQueryFunctionArguments, primID));
static_assert(offsetof(NearTriangle::Ball, radius) == offsetof(RTCPointQuery, radius));

// Embree reports errors to a callback, maybe on a thread of its own, and asks another before it
// takes memory; both find this.
struct RayDevice::State {
  RTCDevice device = nullptr;
  std::int64_t budget_bytes = 0;
  std::atomic<std::int64_t> held_bytes{0};
  std::mutex mutex;  // guards the first error that has not been thrown
  RTCError error = RTC_ERROR_NONE;
  std::string text;

  State() = default;
  ~State() {
    if (device) rtcReleaseDevice(device);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void report(RTCError reported, const char* what) {
    const std::lock_guard lock(mutex);
    if (error == RTC_ERROR_NONE) error = reported, text = what ? what : "";
  }
  // Throws what has been reported since it was asked last.
  void check() {
    const std::lock_guard lock(mutex);
    const RTCError reported = std::exchange(error, RTC_ERROR_NONE);
    if (reported == RTC_ERROR_OUT_OF_MEMORY) throw MachineError("Embree: out of memory");
    VIEWCELL_CHECK(reported == RTC_ERROR_NONE, "Embree:", text, "error =", reported);
  }
  bool may_hold(std::int64_t more_bytes) {
    const std::int64_t held = held_bytes += more_bytes;
    return more_bytes <= 0 || held <= budget_bytes;
  }
};

RayDevice::RayDevice(const RayDeviceOptions& options) : state_(std::make_shared<State>()) {
  const int threads = options.n_threads > 0 ? options.n_threads : hardware_threads();
  state_->device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  if (!state_->device) throw MachineError("Embree: cannot start");
  rtcSetDeviceErrorFunction(
      state_->device,
      [](void* state, RTCError error, const char* text) {
        static_cast<State*>(state)->report(error, text);
      },
      state_.get());
  if (options.budget_bytes == 0) return;
  state_->budget_bytes = static_cast<std::int64_t>(options.budget_bytes);
  rtcSetDeviceMemoryMonitorFunction(
      state_->device,
      [](void* state, ssize_t bytes, bool) { return static_cast<State*>(state)->may_hold(bytes); },
      state_.get());
}

RayDevice::~RayDevice() = default;
RayDevice::RayDevice(RayDevice&&) noexcept = default;
RayDevice& RayDevice::operator=(RayDevice&&) noexcept = default;

namespace {

struct ReleaseGeometry {
  using pointer = RTCGeometry;
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Geometry = std::unique_ptr<RTCGeometry, ReleaseGeometry>;

RTCScene rtc_scene(void* scene) {
  return static_cast<RTCScene>(scene);
}

// Turns away hits on the back of a triangle: Embree's Ng points to the side from which the corners
// run counter-clockwise.
void reject_back_faces(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const float along = RTCRayN_dir_x(args->ray, args->N, i) * RTCHitN_Ng_x(args->hit, args->N, i) +
                        RTCRayN_dir_y(args->ray, args->N, i) * RTCHitN_Ng_y(args->hit, args->N, i) +
                        RTCRayN_dir_z(args->ray, args->N, i) * RTCHitN_Ng_z(args->hit, args->N, i);
    if (along >= 0) args->valid[i] = 0;
  }
}

}  // namespace

void RayScene::Release::operator()(void* scene) const {
  rtcReleaseScene(rtc_scene(scene));
}

RayScene::RayScene() = default;

RayScene::RayScene(const RayDevice& device, std::span<const glm::vec3> positions,
                   std::span<const Corners> triangles, const RaySceneOptions& options)
    : state_(device.state_), scene_(rtcNewScene(state_->device)) {
  state_->check();
  if (options.robust) rtcSetSceneFlags(rtc_scene(scene_.get()), RTC_SCENE_FLAG_ROBUST);
  const Geometry geometry(rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE));
  state_->check();
  // Embree reads 16 bytes at the last vertex, so its buffers are its own, padded, not ours.
  const auto copy = [&]<typename T>(RTCBufferType type, RTCFormat format, std::span<const T> from) {
    void* buffer = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, sizeof(T), from.size());
    state_->check();
    std::copy(from.begin(), from.end(), static_cast<T*>(buffer));
  };
  copy(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions);
  copy(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  if (options.fronts_only) rtcSetGeometryIntersectFilterFunction(geometry.get(), reject_back_faces);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(rtc_scene(scene_.get()), geometry.get());
  state_->check();
  rtcCommitScene(rtc_scene(scene_.get()));
  state_->check();
}

RayScene::RayScene(const RayDevice& device, std::span<const Instance> instances)
    : state_(device.state_), scene_(rtcNewScene(state_->device)) {
  state_->check();
  for (const Instance& instance : instances) {
    const Geometry geometry(rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_INSTANCE));
    state_->check();
    rtcSetGeometryInstancedScene(geometry.get(), rtc_scene(instance.mesh->scene_.get()));
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            glm::value_ptr(instance.world_from_mesh));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(rtc_scene(scene_.get()), geometry.get());  // its number is the instance's
    state_->check();
  }
  rtcCommitScene(rtc_scene(scene_.get()));
  state_->check();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;

// Not the default: the scene goes before the state that it may still report to.
RayScene& RayScene::operator=(RayScene&& other) noexcept {
  scene_ = std::move(other.scene_);
  state_ = std::move(other.state_);
  return *this;
}

void RayScene::intersect(const RayMask& mask, RayPacket& packet) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  // Where the processor has no AVX-512, Embree 3 casts all 16 rays, whatever the mask says; those
  // that end before they begin hit nothing.
  const RayPacket::Lanes<float> far = packet.far;
  for (std::size_t i = 0; i < far.size(); ++i)
    if (mask.lanes[i] == 0) packet.far[i] = -std::numeric_limits<float>::infinity();
  rtcIntersect16(mask.lanes.data(), rtc_scene(scene_.get()), &context,
                 reinterpret_cast<RTCRayHit16*>(&packet));
  for (std::size_t i = 0; i < far.size(); ++i)
    if (mask.lanes[i] == 0) packet.far[i] = far[i];
}

void RayScene::visit_near(const glm::vec3& p, float radius, VisitNear visit, void* user) const {
  RTCPointQuery query;
  query.x = p.x, query.y = p.y, query.z = p.z;
  query.time = 0;
  query.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(rtc_scene(scene_.get()), &query, &context, visit, user);
}

}  // namespace viewcell
