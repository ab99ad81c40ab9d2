#include "host/read/gltf_unpack.h"

#ifdef VKH_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace vkh::gltf {
namespace {

bool fits_filter(const Packed& packed) {
  switch (packed.filter) {
    case Filter::kPlain:
      return true;
    case Filter::kOctahedral:
      return packed.stride == 4 || packed.stride == 8;
    case Filter::kQuaternion:
      return packed.stride == 8;
    case Filter::kExponential:
      return packed.stride % 4 == 0;
    case Filter::kUnknown:
      break;
  }
  return false;
}

bool fits_packing(const Packed& packed) {
  const bool is_index = packed.stride == 2 || packed.stride == 4;
  switch (packed.packing) {
    case Packing::kAttributes:
      return packed.stride % 4 == 0 && packed.stride <= 256;
    case Packing::kTriangles:
      return is_index && packed.count % 3 == 0 && packed.filter == Filter::kPlain;
    case Packing::kIndices:
      return is_index && packed.filter == Filter::kPlain;
    case Packing::kUnknown:
      break;
  }
  return false;
}

}  // namespace

// The codecs write at least two bits for sixteen bytes of vertices, and a byte for a triangle or an
// index: nothing grows more than 64 times.
const char* unpack_problem(const Packed& packed) {
#ifndef VKH_HAS_MESHOPTIMIZER
  return "meshopt compression: this program was built without libmeshoptimizer-dev";
#endif
  if (!fits_packing(packed) || !fits_filter(packed))
    return "mode, filter, count or byteStride that do not go together";
  return unpacked_bytes(packed) / 64 > packed.length ? "more elements than its bytes can hold"
                                                     : nullptr;
}

#ifdef VKH_HAS_MESHOPTIMIZER
bool unpack(const Packed& packed, std::string_view from, std::vector<char>& out) {
  out.resize(unpacked_bytes(packed));
  const auto* bytes = reinterpret_cast<const unsigned char*>(from.data());
  const size_t count = packed.count, stride = packed.stride;
  int error = 0;
  switch (packed.packing) {
    case Packing::kTriangles:
      error = meshopt_decodeIndexBuffer(out.data(), count, stride, bytes, from.size());
      break;
    case Packing::kIndices:
      error = meshopt_decodeIndexSequence(out.data(), count, stride, bytes, from.size());
      break;
    default:
      error = meshopt_decodeVertexBuffer(out.data(), count, stride, bytes, from.size());
  }
  if (error != 0) return false;
  if (packed.filter == Filter::kOctahedral) meshopt_decodeFilterOct(out.data(), count, stride);
  if (packed.filter == Filter::kQuaternion) meshopt_decodeFilterQuat(out.data(), count, stride);
  if (packed.filter == Filter::kExponential) meshopt_decodeFilterExp(out.data(), count, stride);
  return true;
}
#else
bool unpack(const Packed& /*packed*/, std::string_view /*from*/, std::vector<char>& /*out*/) {
  return false;
}
#endif

}  // namespace vkh::gltf
