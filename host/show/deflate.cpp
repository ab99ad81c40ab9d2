// A text is cut into pieces, which are deflated apart and joined, as pigz does: each but the last
// ends at a byte, and may repeat what is in the 32 KiB of its part before it.
#include "host/show/deflate.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>
#ifdef VKH_HAS_ZLIB
#include <zlib.h>
#endif

#include "host/base/parallel.h"

namespace vkh {

#ifdef VKH_HAS_ZLIB
namespace {

constexpr size_t kWindowBytes = size_t{1} << 15, kPieceBytes = size_t{1} << 18;

struct Piece {
  std::string_view before, bytes;
  Deflate how;
  bool is_last;
};

/// A stream without header and sum, which are of the whole text.
class RawStream {
 public:
  explicit RawStream(Deflate how) {
    constexpr int kWindowBits = 15, kMemory = 8;  // zlib's own
    const int level = how == Deflate::kThorough ? 6 : 3;
    const int strategy = how == Deflate::kCodes ? Z_HUFFMAN_ONLY : Z_DEFAULT_STRATEGY;
    if (deflateInit2(&stream_, level, Z_DEFLATED, -kWindowBits, kMemory, strategy) != Z_OK)
      throw std::bad_alloc();
  }
  RawStream(const RawStream&) = delete;
  RawStream& operator=(const RawStream&) = delete;
  ~RawStream() { deflateEnd(&stream_); }

  void may_repeat(std::string_view before) {
    deflateSetDictionary(&stream_, bytes_of(before), static_cast<uInt>(before.size()));
  }
  std::string deflated(std::string_view bytes, int flush) {
    constexpr size_t kOfFlush = 16;  // more than the empty block of a flush takes
    std::string out(deflateBound(&stream_, static_cast<uLong>(bytes.size())) + kOfFlush, '\0');
    stream_.next_in = bytes_of(bytes);
    stream_.avail_in = static_cast<uInt>(bytes.size());
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(out.size());
    const int found = deflate(&stream_, flush);
    if (found != (flush == Z_FINISH ? Z_STREAM_END : Z_OK) || stream_.avail_out == 0)
      throw std::logic_error("a text was not deflated");
    out.resize(stream_.total_out);
    return out;
  }

 private:
  static Bytef* bytes_of(std::string_view text) {
    return reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  }
  z_stream stream_{};
};

std::string deflated(const Piece& piece) {
  RawStream stream(piece.how);
  if (!piece.before.empty()) stream.may_repeat(piece.before);
  return stream.deflated(piece.bytes, piece.is_last ? Z_FINISH : Z_SYNC_FLUSH);
}

// At least one piece, for the end of the text.
std::vector<Piece> pieces_of(std::span<const DeflatePart> parts) {
  std::vector<Piece> pieces;
  for (const DeflatePart& part : parts) {
    for (size_t at = 0; at < part.bytes.size(); at += kPieceBytes) {
      const size_t before = std::min(at, kWindowBytes);
      pieces.push_back({part.bytes.substr(at - before, before), part.bytes.substr(at, kPieceBytes),
                        part.how, false});
    }
  }
  if (pieces.empty()) pieces.push_back({{}, {}, Deflate::kQuick, false});
  pieces.back().is_last = true;
  return pieces;
}

uLong sum_of(std::string_view bytes) {
  return adler32(adler32(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uInt>(bytes.size()));
}

}  // namespace

bool can_deflate() { return true; }

std::string deflated(std::span<const DeflatePart> parts) {
  const std::vector<Piece> pieces = pieces_of(parts);
  std::vector<std::string> texts(pieces.size());
  std::vector<uLong> sums(pieces.size());
  for_each_index(pieces.size(), [&](size_t i) {
    texts[i] = deflated(pieces[i]);
    sums[i] = sum_of(pieces[i].bytes);
  });
  std::string all = "\x78\x9c";  // RFC 1950's header: deflate, a window of 32 KiB
  uLong sum = sum_of({});
  for (size_t i = 0; i < pieces.size(); ++i) {
    all += texts[i];
    sum = adler32_combine(sum, sums[i], static_cast<z_off_t>(pieces[i].bytes.size()));
  }
  for (const int shift : {24, 16, 8, 0}) all += static_cast<char>(sum >> shift & 0xff);
  return all;
}

#else

bool can_deflate() { return false; }

std::string deflated(std::span<const DeflatePart>) {
  throw std::logic_error("without zlib nothing can be deflated");
}

#endif

}  // namespace vkh
