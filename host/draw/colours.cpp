#include "host/draw/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "host/base/parallel.h"

namespace vkh::drawing {
namespace {

constexpr size_t kSteps = 256;

// Red, green and blue of each step, two hexadecimal digits each.
// Stéfan van der Walt and Nathaniel Smith, 2015; as in matplotlib 3.6.3, _cm_listed.py (CC0).
constexpr std::string_view kViridis =
    "44015444025645045745055946075a46085c460a5d460b5e470d60470e61471063471164471365481467481668"
    "48176948186a481a6c481b6d481c6e481d6f481f70482071482173482374482475482576482677482878482979"
    "472a7a472c7a472d7b472e7c472f7d46307e46327e46337f463480453581453781453882443983443a83443b84"
    "433d84433e85423f854240864241864142874144874045884046883f47883f48893e49893e4a893e4c8a3d4d8a"
    "3d4e8a3c4f8a3c508b3b518b3b528b3a538b3a548c39558c39568c38588c38598c375a8c375b8d365c8d365d8d"
    "355e8d355f8d34608d34618d33628d33638d32648e32658e31668e31678e31688e30698e306a8e2f6b8e2f6c8e"
    "2e6d8e2e6e8e2e6f8e2d708e2d718e2c718e2c728e2c738e2b748e2b758e2a768e2a778e2a788e29798e297a8e"
    "297b8e287c8e287d8e277e8e277f8e27808e26818e26828e26828e25838e25848e25858e24868e24878e23888e"
    "23898e238a8d228b8d228c8d228d8d218e8d218f8d21908d21918c20928c20928c20938c1f948c1f958b1f968b"
    "1f978b1f988b1f998a1f9a8a1e9b8a1e9c891e9d891f9e891f9f881fa0881fa1881fa1871fa28720a38620a486"
    "21a58521a68522a78522a88423a98324aa8325ab8225ac8226ad8127ad8128ae8029af7f2ab07f2cb17e2db27d"
    "2eb37c2fb47c31b57b32b67a34b67935b77937b87838b9773aba763bbb753dbc743fbc7340bd7242be7144bf70"
    "46c06f48c16e4ac16d4cc26c4ec36b50c46a52c56954c56856c66758c7655ac8645cc8635ec96260ca6063cb5f"
    "65cb5e67cc5c69cd5b6ccd5a6ece5870cf5773d05675d05477d1537ad1517cd2507fd34e81d34d84d44b86d549"
    "89d5488bd6468ed64590d74393d74195d84098d83e9bd93c9dd93ba0da39a2da37a5db36a8db34aadc32addc30"
    "b0dd2fb2dd2db5de2bb8de29bade28bddf26c0df25c2df23c5e021c8e020cae11fcde11dd0e11cd2e21bd5e21a"
    "d8e219dae319dde318dfe318e2e418e5e419e7e419eae51aece51befe51cf1e51df4e61ef6e620f8e621fbe723"
    "fde725";

// Fabio Crameri, Scientific Colour Maps 7.0.1, doi:10.5281/zenodo.5501399 (MIT licence, copyright
// (c) 2021, Fabio Crameri); as in GMT 6.4's SCM/batlow.cpt.
constexpr std::string_view kBatlow =
    "011959021b59031c5a041e5a051f5a06215b07225b07245b08255b09275c0a285c0a2a5c0b2b5c0b2d5d0c2e5d"
    "0c2f5d0d315d0d325e0d335e0e355e0e365e0e375e0f385f0f395f0f3b5f0f3c5f103d5f103e5f103f60104060"
    "114160114260114360114460124561124661124761124861134961134a61134b61144c62144d62144e62154f62"
    "154f621650621651621752621753621854621855621956621957621a57621b58621b59621c5a621d5b621e5c62"
    "1e5d621f5d61205e61215f6122606123606024616025626026635f27635f28645f2a655e2b655e2c665d2d675d"
    "2f675c30685c31695b33695a346a5a356a59376b58386c583a6c573b6d563c6d563e6e553f6e54416f53426f52"
    "44705245705147715048714f4a724e4c724d4d734d4f734c50744b52744a5375495575485776475876465a7745"
    "5b77455d78445f7843607942627941637a40657a3f677b3e687b3e6a7b3d6c7c3c6d7c3b6f7d3a717d39737e38"
    "747e38767f37787f367980357b80347d81347f813381823282823184833186833088842f8a842f8c852e8e852e"
    "8f862d91862d93872c95872c97882c99882c9b892b9d892b9f892ba18a2ba38a2ca58b2ca78b2ca98c2cab8c2d"
    "ad8c2daf8d2eb18d2fb38e2fb58e30b78e31b98f32bb8f33bd8f34be9035c09036c29037c49138c6913ac8913b"
    "ca923ccb923ecd923fcf9340d19342d29343d49445d69446d89448d9954adb954bdd954dde964fe09651e19752"
    "e39754e49756e69858e7985ae9995cea995eeb9a60ed9a62ee9b64ef9b67f09c69f19d6bf29d6df39e70f49f72"
    "f59f74f6a077f7a179f8a17bf8a27ef9a380f9a382faa485faa587fba689fba68cfca78efca890fca993fca995"
    "fdaa97fdab9afdac9cfdac9efdada0fdaea2fdafa5fdafa7fdb0a9fdb1abfdb2adfdb2affdb3b1fdb4b4fdb4b6"
    "fdb5b8fdb6bafdb7bcfdb7befdb8c0fdb9c2fdbac4fdbac7fdbbc9fdbccbfdbccdfcbdcffcbed1fcbfd3fcbfd6"
    "fcc0d8fcc1dafcc2dcfcc3dffcc3e1fcc4e3fcc5e5fbc6e8fbc6eafbc7ecfbc8effbc9f1fbcaf3fbcaf6facbf8"
    "faccfa";

// Nuñez, Anderton and Renslow, doi:10.1371/journal.pone.0199239; as in matplotlib 3.6.3,
// _cm_listed.py (CC0).
constexpr std::string_view kCividis =
    "00224e00234f00245100255300255400265600275800285900285b00295d002a5f002a61002b62002c64002c66"
    "002d68002e6a002e6c002f6d00306f0030700031700031710132710533710833700c34700f3570123570143670"
    "16377018376f1a386f1c396f1e3a6f203a6f213b6e233c6e243c6e263d6e273e6e293f6e2a3f6d2b406d2d416d"
    "2e416d2f426d31436d32436d33446d34456c35456c36466c38476c39486c3a486c3b496c3c4a6c3d4a6c3e4b6c"
    "3f4c6c404c6c414d6c424e6c434e6c444f6c45506c46516c47516c48526c49536c4a536c4b546c4c556c4d556c"
    "4e566c4f576c50576c51586d52596d535a6d545a6d555b6d555c6d565c6d575d6d585e6d595e6e5a5f6e5b606e"
    "5c616e5d616e5e626e5e636f5f636f60646f61656f62656f636670646770656870656870666970676a71686a71"
    "696b716a6c716b6d726c6d726c6e726d6f726e6f736f7073707173717274727274727374737475747475757575"
    "7676767777767777777878777979777a7a787b7a787c7b787d7c787e7c787e7d787f7e78807f78817f78828079"
    "8381798482798582798683798784788885788985788a86788b87788c88788d88788e89788f8a78908b78918b78"
    "928c78928d78938e78948e77958f779690779791779892779992779a93769b94769c95769d95769e96769f9775"
    "a09875a19975a29975a39a74a49b74a59c74a69c74a79d73a89e73a99f73aaa073aba072aca172ada272aea371"
    "afa471b0a571b1a570b3a670b4a76fb5a86fb6a96fb7a96eb8aa6eb9ab6dbaac6dbbad6dbcae6cbdae6cbeaf6b"
    "bfb06bc0b16ac1b26ac2b369c3b369c4b468c5b568c6b667c7b767c8b866c9b965cbb965ccba64cdbb63cebc63"
    "cfbd62d0be62d1bf61d2c060d3c05fd4c15fd5c25ed6c35dd7c45cd9c55cdac65bdbc75adcc859ddc858dec958"
    "dfca57e0cb56e1cc55e2cd54e4ce53e5cf52e6d051e7d150e8d24fe9d34eead34cebd44bedd54aeed649efd748"
    "f0d846f1d945f2da44f3db42f5dc41f6dd3ff7de3ef8df3cf9e03afbe138fce236fde334fee434fee535fee636"
    "fee838";

static_assert(kViridis.size() == 6 * kSteps && kBatlow.size() == 6 * kSteps &&
              kCividis.size() == 6 * kSteps);

uint8_t byte_at(std::string_view digits, size_t at) {
  const auto value = [&](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  return static_cast<uint8_t>(16 * value(digits[at]) + value(digits[at + 1]));
}

std::string_view table_of(ColourMap map) {
  if (map == ColourMap::kBatlow) return kBatlow;
  return map == ColourMap::kCividis ? kCividis : kViridis;
}

double largest_finite(const std::vector<double>& values) {
  double largest = 0;
  for (const double v : values) {
    if (std::isfinite(v)) largest = std::max(largest, v);
  }
  return largest;
}

/// One where a face looks at the viewer, so that its colour is the map's own. Light comes from the
/// upper left, and falls on both sides of a face. `normal`: as the viewer sees it, of any length.
double light_on(glm::dvec3 normal) {
  constexpr double kDarkest = 0.6;
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.32, 0.42, 0.85));
  const double length = glm::length(normal);
  if (!(length > 0)) return 1;
  // Wrapped around the edges of what is lit, so that faces turned away keep their shape.
  const double lit = glm::dot(normal, light) * (normal.z < 0 ? -1 : 1) / length;
  const double share = std::min((1 + lit) / (1 + light.z), 1.0);
  return kDarkest + (1 - kDarkest) * share * share;
}

/// How dark edges are: not at all where a face is so thin that its edges would be most of it.
uint8_t edge_strength(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kNone = 8, kFull = 22, kDarkest = 0.38;  // altitudes in pixels; share
  const glm::dvec2 u(b - a), v(c - a), w(c - b);
  const double longest = std::sqrt(std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)}));
  if (!(longest > 0)) return 0;
  const double altitude = std::abs(u.x * v.y - u.y * v.x) / longest;
  const double share = std::clamp((altitude - kNone) / (kFull - kNone), 0.0, 1.0);
  return static_cast<uint8_t>(std::lround(255 * kDarkest * share));
}

class FaceWriter {
 public:
  FaceWriter(const Picture& picture, const Scale& scale, const Camera& camera)
      : picture_(picture), scale_(scale), camera_(camera) {}

  void operator()(size_t face, Corner* corners) const {
    std::array<glm::dvec3, 3> at;
    for (size_t i = 0; i < at.size(); ++i) {
      const auto corner = static_cast<glm::length_t>(i);
      at[i] = camera_.pixel(picture_.mesh.vertices[picture_.mesh.faces[face][corner]]);
    }
    const FaceLook look = look_of(picture_, scale_, face);
    const double light = light_on(normal_of(at));
    const auto lit = [&](uint8_t c) { return static_cast<uint8_t>(std::lround(c * light)); };
    const uint8_t edges = edge_strength(at[0], at[1], at[2]);
    for (size_t i = 0; i < at.size(); ++i) {
      const glm::dvec3 clip = clipped(at[i]);
      corners[i] = {static_cast<float>(clip.x),
                    static_cast<float>(clip.y),
                    static_cast<float>(clip.z),
                    {lit(look.colour.red), lit(look.colour.green), lit(look.colour.blue), edges},
                    static_cast<uint8_t>(look.hatched ? 1 : 0),
                    {}};
    }
  }

 private:
  // Of what is seen, so a pixel's y turns around, and its depth is in pixels, too.
  glm::dvec3 normal_of(const std::array<glm::dvec3, 3>& at) const {
    const auto seen = [&](size_t i) {
      return glm::dvec3(at[i].x, -at[i].y, at[i].z * camera_.scale);
    };
    return glm::cross(seen(1) - seen(0), seen(2) - seen(0));
  }
  glm::dvec3 clipped(const glm::dvec3& pixel) const {
    const Area& area = camera_.area;
    return {2 * (pixel.x - area.x) / area.width - 1, 2 * (pixel.y - area.y) / area.height - 1,
            (camera_.before - pixel.z) / (camera_.before + camera_.reach)};
  }

  const Picture& picture_;
  const Scale& scale_;
  const Camera& camera_;
};

}  // namespace

FillFaces faces_for(const Picture& picture, const Scale& scale, const Camera& camera) {
  return
      [writer = FaceWriter(picture, scale, camera)](size_t first, size_t count, Corner* corners) {
        constexpr size_t kPiece = 4096;
        for_each_index((count + kPiece - 1) / kPiece, [&](size_t piece) {
          const size_t end = std::min(count, (piece + 1) * kPiece);
          for (size_t i = piece * kPiece; i < end; ++i) writer(first + i, corners + 3 * i);
        });
      };
}

Rgb map_colour(ColourMap map, double share) {
  const double step = std::ceil(std::clamp(share, 0.0, 1.0) * (kSteps - 1));
  const size_t at = 6 * static_cast<size_t>(step);
  const std::string_view table = table_of(map);
  return {byte_at(table, at), byte_at(table, at + 2), byte_at(table, at + 4)};
}

Scale::Scale(const Picture& picture, const PictureOptions& options)
    : map_(options.map), bands_(options.bands) {
  const double upper = picture.interval.upper;
  const double shown = std::isfinite(upper) ? upper : 0;  // the bar has room for it, too
  range_ =
      options.range.value_or(Enclosure{0, std::max(shown, largest_finite(picture.field.upper))});
}

double Scale::share_of(double length) const {
  const double width = range_.upper - range_.lower;
  // A range without width has one colour, and what is above it another.
  if (!(width > 0)) return length > range_.upper ? 1 : 0;
  return std::clamp(length / width - range_.lower / width, 0.0, 1.0);
}

Rgb Scale::at_share(double share) const {
  if (bands_ == 0) return map_colour(map_, share);
  const double band = std::max(std::ceil(share * bands_), 1.0);  // an edge is the lower band's
  return map_colour(map_, bands_ == 1 ? 0.5 : (band - 1) / (bands_ - 1));
}

Rgb verdict_colour(Verdict verdict) {
  if (verdict == Verdict::kWithin) return {133, 178, 216};
  return verdict == Verdict::kBeyond ? Rgb{203, 38, 35} : Rgb{246, 205, 116};
}

FaceLook look_of(const Picture& picture, const Scale& scale, size_t face) {
  if (picture.limit) {
    const Verdict verdict = verdict_of(picture.field, face, *picture.limit);
    return {verdict_colour(verdict), verdict == Verdict::kUndecided};
  }
  const double upper = picture.field.upper[face];
  if (!std::isfinite(upper)) return {kUnbounded, true};
  return {scale.colour(upper), false};
}

FaceCounts count_faces(const Picture& picture, const Scale& scale) {
  FaceCounts counts;
  for (size_t face = 0; face < picture.field.face_count(); ++face) {
    if (picture.limit) {
      const Verdict verdict = verdict_of(picture.field, face, *picture.limit);
      ++(verdict == Verdict::kWithin   ? counts.within
         : verdict == Verdict::kBeyond ? counts.beyond
                                       : counts.undecided);
      continue;
    }
    const double upper = picture.field.upper[face];
    if (!std::isfinite(upper)) {
      ++counts.unbounded;
    } else if (upper > scale.range().upper) {
      ++counts.above;
    }
  }
  return counts;
}

}  // namespace vkh::drawing
