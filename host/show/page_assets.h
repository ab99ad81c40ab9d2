// The assets that tools/page makes and the build embeds (tools/page/embed.py).
#pragma once

#include <string_view>

namespace vkh {

/// The page's frame, with a {{name}} for each piece that page.cpp puts in.
extern const std::string_view kPageTemplate;
extern const std::string_view kPageStyle, kPageViewer;
/// Their SHA-256 in base64, for the Content-Security-Policy: nothing else may run.
extern const std::string_view kPageStyleHash, kPageViewerHash;

}  // namespace vkh
