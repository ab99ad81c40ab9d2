// vkh_renderer: draws frames off screen and writes them as PNG, with one line of CSV each: of a
// mesh that deforms, or with --chain of a file's, by its levels of proven errors.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include "examples/renderer/chain.h"

namespace {

struct Options {
  example::RendererOptions renderer;
  uint32_t frames = 60;
  float nearest = 2.6f, farthest = 14;  // the camera's distances
  std::string folder = ".";
  std::string chain;  // what simplify --levels --json=FILE wrote; empty: the mesh that deforms
};

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto text = [&]() -> std::string {
      if (i + 1 == argc) throw std::runtime_error(name + " needs a value");
      return argv[++i];
    };
    const auto number = [&] { return static_cast<uint32_t>(std::stoul(text())); };
    if (name == "--frames") {
      o.frames = number();
    } else if (name == "--size") {
      o.renderer.width = number();
      o.renderer.height = number();
    } else if (name == "--cells") {
      o.renderer.cells_u = number() / 8 * 8;
      o.renderer.cells_v = number() / 8 * 8;
    } else if (name == "--waves") {
      o.renderer.waves = number();
    } else if (name == "--camera") {
      o.nearest = std::stof(text());
      o.farthest = std::stof(text());
    } else if (name == "--chain") {
      o.chain = text();
    } else if (name == "--out") {
      o.folder = text();
    } else if (name == "--validation") {
      o.renderer.validation = true;
    } else {
      throw std::runtime_error(
          "usage: vkh_renderer [--frames N] [--size W H] [--cells U V] [--waves N] "
          "[--camera NEAREST FARTHEST] [--chain LOD.json] [--out FOLDER] [--validation]");
    }
  }
  if (o.frames == 0 || o.renderer.width < 320 || o.renderer.height < 240 ||
      o.renderer.cells_u < 24 || o.renderer.cells_v < 24 || !(o.nearest >= 2.2f))
    throw std::runtime_error(
        "at least 1 frame of 320 x 240 pixels, 24 x 24 cells, and a camera at 2.2 or more");
  return o;
}

void write_png(const Options& o, uint32_t number, const uint8_t* rgba) {
  char name[32];
  std::snprintf(name, sizeof(name), "frame_%03u.png", number);
  const std::string path = (std::filesystem::path(o.folder) / name).string();
  const auto width = static_cast<int>(o.renderer.width);
  const auto height = static_cast<int>(o.renderer.height);
  if (stbi_write_png(path.c_str(), width, height, 4, rgba, 4 * width) == 0)
    throw std::runtime_error("cannot write " + path);
}

void print(uint32_t number, const example::RenderedFrame& f) {
  std::printf("%u,%u,%.9g", number, f.drawn, static_cast<double>(f.pixel));
  for (const VkhReport& r : f.reports)
    std::printf(",%.9g,%.9g", static_cast<double>(r.lower), static_cast<double>(r.upper));
  std::printf("\n");
}

float camera_of(const Options& o, uint32_t frame) {
  const float part =
      o.frames == 1 ? 0 : static_cast<float>(frame) / static_cast<float>(o.frames - 1);
  return o.nearest + part * (o.farthest - o.nearest);
}

uint32_t draw_deforming(const Options& o) {
  example::Renderer renderer(o.renderer);
  std::puts("frame,drawn,pixel,lower1,upper1,lower2,upper2,lower3,upper3");
  for (uint32_t i = 0; i < o.frames; ++i) {
    const example::RenderedFrame f =
        renderer.frame(i, 0.1f * static_cast<float>(i), camera_of(o, i));
    write_png(o, i, f.rgba);
    print(i, f);
  }
  return renderer.gpu().validation_messages();
}

uint32_t draw_chain(const Options& o) {
  example::ChainRenderer renderer(o.renderer, example::read_chain(o.chain));
  std::puts("frame,drawn,faces,error,pixel");
  for (uint32_t i = 0; i < o.frames; ++i) {
    const example::ChainFrame f = renderer.frame(0.05f * static_cast<float>(i), camera_of(o, i));
    write_png(o, i, f.rgba);
    std::printf("%u,%u,%u,%.9g,%.9g\n", i, f.drawn, f.faces, static_cast<double>(f.error),
                static_cast<double>(f.pixel));
  }
  return renderer.gpu().validation_messages();
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = parse(argc, argv);
  std::filesystem::create_directories(o.folder);
  return (o.chain.empty() ? draw_deforming(o) : draw_chain(o)) == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "vkh_renderer: %s\n", error.what());
  return 1;
}
