// The assets that tools/page makes and the build embeds (tools/page/embed.py).
#pragma once

#include <string_view>

namespace vkh {

/// Templates of a pair's page and of a batch's index (host/show/template.h).
extern const std::string_view kPageTemplate, kIndexTemplate;
extern const std::string_view kPageStyle, kPageViewer, kIndexStyle;
/// Their SHA-256 in base64, for the Content-Security-Policy: nothing else may run.
extern const std::string_view kPageStyleHash, kPageViewerHash, kIndexStyleHash;

}  // namespace vkh
