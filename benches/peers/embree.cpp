// Casts rays that main.rs wrote to a file one by one with Embree, on one thread.
//
// Reads the name of the file from the command line, then for each line on standard input casts all
// rays once and answers with the nanoseconds that took and how many of the rays met something.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

struct Cast {
  float origin[3];
  float direction[3];
  // Rays that leave a surface start a little above it.
  float nearest;
  // Where our own cast meets the mesh; negative when it misses.
  float expected;
};

template <typename Item>
std::vector<Item> read_items(std::ifstream& file) {
  std::uint64_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  std::vector<Item> items(count);
  file.read(reinterpret_cast<char*>(items.data()), count * sizeof(Item));
  if (!file) {
    std::fprintf(stderr, "the file of rays is cut short\n");
    std::exit(2);
  }
  return items;
}

struct Corner {
  float at[3];
};
struct Triangle {
  std::uint32_t corners[3];
};

RTCScene build(RTCDevice device, const std::vector<Corner>& corners,
               const std::vector<Triangle>& triangles) {
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* to_corners = static_cast<Corner*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Corner), corners.size()));
  std::copy(corners.begin(), corners.end(), to_corners);
  auto* to_triangles = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), triangles.size()));
  std::copy(triangles.begin(), triangles.end(), to_triangles);
  rtcCommitGeometry(mesh);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene);
  return scene;
}

RTCRayHit cast(RTCScene scene, const Cast& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray.org_x = ray.origin[0];
  query.ray.org_y = ray.origin[1];
  query.ray.org_z = ray.origin[2];
  query.ray.dir_x = ray.direction[0];
  query.ray.dir_y = ray.direction[1];
  query.ray.dir_z = ray.direction[2];
  query.ray.tnear = ray.nearest;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.time = 0;
  query.ray.mask = -1;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  return query;
}

// Whether Embree's distance is ours, as far as single precision goes.
bool agrees(const RTCRayHit& met, const Cast& ray) {
  if (met.hit.geomID == RTC_INVALID_GEOMETRY_ID) return ray.expected < 0;
  return std::abs(met.ray.tfar - ray.expected) <= 1e-6f + 1e-4f * ray.expected;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: embree FILE\n");
    return 2;
  }
  std::ifstream file(argv[1], std::ios::binary);
  const auto corners = read_items<Corner>(file);
  const auto triangles = read_items<Triangle>(file);
  const auto rays = read_items<Cast>(file);
  RTCDevice device = rtcNewDevice("threads=1");
  const auto start = std::chrono::steady_clock::now();
  RTCScene scene = build(device, corners, triangles);
  const std::chrono::duration<double> building = std::chrono::steady_clock::now() - start;
  std::size_t agreeing = 0;
  for (const Cast& ray : rays) agreeing += agrees(cast(scene, ray), ray);
  std::printf("%g %zu\n", building.count(), agreeing);
  std::fflush(stdout);
  while (std::getchar() == '\n') {
    std::size_t hits = 0;
    const auto start = std::chrono::steady_clock::now();
    for (const Cast& ray : rays)
      hits += cast(scene, ray).hit.geomID != RTC_INVALID_GEOMETRY_ID;
    const std::chrono::nanoseconds taken = std::chrono::steady_clock::now() - start;
    std::printf("%lld %zu\n", static_cast<long long>(taken.count()), hits);
    std::fflush(stdout);
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
