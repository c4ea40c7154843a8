// Sizes that fit on the bus. A scene beyond them is refused while loading; a message beyond them is
// refused where it arrives.

#pragma once

#include <cstddef>

namespace poinsot {

inline constexpr std::size_t kMaxBodies = 131072;       // in one frame
inline constexpr std::size_t kMaxNameLength = 127;      // bytes of a body's or world's name
inline constexpr std::size_t kMaxMessageLength = 1023;  // bytes of a reply's text; longer is cut
inline constexpr std::size_t kMaxShapes = 64;           // of one body
inline constexpr std::size_t kMaxVertices = 4096;       // of one convex shape
inline constexpr std::size_t kMaxFaceIndices = 32768;   // of one convex shape: corners and faces

}  // namespace poinsot
