// Sizes that fit on the bus, and numbers that are still plausible. A scene beyond them is refused
// while loading; a message beyond them is refused where it arrives.

#pragma once

#include <cstddef>
#include <cstdint>

namespace poinsot {

inline constexpr std::size_t kMaxBodies = 131072;       // in one frame
inline constexpr std::size_t kMaxNameLength = 127;      // bytes of a body's or world's name
inline constexpr std::size_t kMaxMessageLength = 1023;  // bytes of a reply's text; longer is cut
inline constexpr std::size_t kMaxShapes = 64;           // of one body
inline constexpr std::size_t kMaxVertices = 4096;       // of one convex shape
inline constexpr std::size_t kMaxFaceIndices = 32768;   // of one convex shape: corners and faces

inline constexpr std::size_t kMaxMeshVertices = 65536;  // of one mesh
inline constexpr std::size_t kMaxTriangles = 131072;    // of one mesh

inline constexpr std::size_t kMaxSprings = 131072;      // of one scene
inline constexpr std::size_t kMaxPairs = 131072;        // of one scene, with rules of their own
inline constexpr std::size_t kMaxHeldWrenches = 65536;  // at once, of the scene and all clients

inline constexpr std::size_t kMaxContacts = 65536;      // of one frame on the bus
inline constexpr std::size_t kMaxListed = 4096;         // held wrenches on the bus
inline constexpr std::size_t kMaxHeldPerClient = 4096;  // wrenches at once, of one client
inline constexpr std::size_t kMaxClients = 64;          // told of in a report

// The largest force [N] or torque [N·m] component and point coordinate [m] that is accepted.
inline constexpr double kMaxWrench = 1e12;
inline constexpr double kMaxPoint = 1e9;
// The largest stiffness [N/m] or damping [N·s/m] of a tether that is accepted.
inline constexpr double kMaxStiffness = 1e12;
// The largest speed that a body may be given [m/s], [rad/s].
inline constexpr double kMaxSpeed = 1e9;
// The longest duration that is accepted: about 31 years of simulated time [ns].
inline constexpr std::int64_t kMaxDurationNs = 1'000'000'000'000'000'000;

}  // namespace poinsot
