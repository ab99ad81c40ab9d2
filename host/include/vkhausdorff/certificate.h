// A certificate file; docs/certificate-file.md fixes its bytes.
#pragma once

#include <optional>
#include <string>

#include "vkhausdorff/prover.h"

namespace vkh {

struct CertifiedDirection {
  const Report& report;
  const Proof& proof;
};

struct CertifiedMesh {
  const Mesh& mesh;
  std::string sha256;  ///< hash of its file, in hexadecimal digits; empty: it has none
};

/// Throws OutputError where this build cannot hash, and UsageError for a Proof that no prover made.
std::string certificate_of(const CertifiedMesh& a, const CertifiedMesh& b,
                           const CertifiedDirection& a_to_b,
                           const std::optional<CertifiedDirection>& b_to_a);

}  // namespace vkh
