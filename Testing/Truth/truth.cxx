// Makes points of a scene whose true picture is known, and that picture: for tables of techniques.
//   truth town|knot --view far|mid|close|graze --spacing-px S --sampling blue|scan -o DIR
//   truth ... --pan-px D -o DIR   camera.json and truth.png of a camera that stands so many pixels'
//                                 width to the right: how much of a flicker is the scene's
// Writes into DIR: points.ply, camera.json, truth.png, mask.png (white where the surface covers the
// whole pixel), depth.f32 (see TruthFiles.h), truth.json (spacing, background ...) and, with
// --oracle, oracle.png.
#include "OraclePicture.h"
#include "TruthCase.h"
#include "TruthFiles.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>

namespace
{
using namespace pointfront;

struct Options
{
  std::string scene;
  std::string view = "far";
  std::string sampling = "blue";
  std::string folder;
  double spacingPx = 1.0;
  std::uint32_t width = 800;
  std::uint32_t height = 600;
  unsigned samples = 8;
  std::uint64_t seed = 11;
  double panPx = 0.0;
  bool oracle = false;
};

void declare(CLI::App& app, Options& options)
{
  app.add_option("scene", options.scene, "town or knot")
    ->required()
    ->check(CLI::IsMember({ "town", "knot" }));
  app.add_option("--view", options.view, "far, mid, close or graze (far)")
    ->check(CLI::IsMember({ "far", "mid", "close", "graze" }));
  app.add_option("--sampling", options.sampling, "blue or scan (blue)")
    ->check(CLI::IsMember({ "blue", "scan" }));
  app.add_option("--spacing-px", options.spacingPx, "Spacing of the points on the screen (1)")
    ->check(CLI::Range(0.05, 100.0));
  app.add_option("--width", options.width, "Pixels (800)")->check(CLI::Range(16, 8192));
  app.add_option("--height", options.height, "Pixels (600)")->check(CLI::Range(16, 8192));
  app.add_option("--samples", options.samples, "Rays a pixel and axis (8)")
    ->check(CLI::Range(1, 64));
  app.add_option("--seed", options.seed, "Other points for another number (11)");
  app.add_option("--pan-px", options.panPx, "Only the picture, from so many pixels to the right")
    ->check(CLI::Range(-100.0, 100.0));
  app.add_flag("--oracle", options.oracle, "Draw what a painter could who knows the surface");
  app.add_option("-o,--output", options.folder, "Folder to write into")->required();
}

/// The picture from a camera beside the view's.
Result<void> drawPanned(const truth::TruthCase& seen, const Options& options)
{
  const std::string folder = options.folder + "/";
  std::filesystem::create_directories(folder);
  const truth::TruthCamera camera = seen.pannedCamera(options.panPx);
  const truth::PixelRays pixels(camera, options.width, options.height);
  const Result<void> done = truth::writeCamera(folder + "camera.json", camera);
  return done ? truth::writePicture(folder + "truth.png",
                  truth::drawTruth(seen.rays(), pixels, options.samples).colours)
              : done;
}

Result<void> run(const Options& options)
{
  const truth::TruthCase seen(*truth::makeScene(options.scene),
    { options.view, options.spacingPx, options.width, options.height });
  if (options.panPx != 0.0)
  {
    return drawPanned(seen, options);
  }
  const truth::TruthPicture picture = seen.draw(options.samples);
  const truth::TruthPoints points =
    options.sampling == "blue" ? seen.blueNoise(options.seed) : seen.scan(options.seed);

  const std::string folder = options.folder + "/";
  std::filesystem::create_directories(folder);
  Result<void> done = truth::writePoints(folder + "points.ply", points);
  done = done ? truth::writeCamera(folder + "camera.json", seen.camera()) : done;
  done = done ? truth::writePicture(folder + "truth.png", picture.colours) : done;
  done = done ? truth::writePicture(folder + "mask.png", picture.mask()) : done;
  done = done ? truth::writeDepth(folder + "depth.f32", picture.depth) : done;
  if (done && options.oracle)
  {
    done = truth::writePicture(
      folder + "oracle.png", truth::drawOracle(picture, seen.pixels(), seen.grade(), points));
  }
  return done ? truth::writeFacts(folder + "truth.json", seen.pixels(), seen.grade(), points)
              : done;
}
} // namespace

int main(int argc, char** argv)
{
  CLI::App app("Points of a scene whose true picture is known", "truth");
  Options options;
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  const Result<void> done = run(options);
  if (!done)
  {
    std::fprintf(stderr, "truth: %s\n", done.error().what.c_str());
    return 1;
  }
  return 0;
}
