// Builds a store from LAS or LAZ files, with progress on standard error.
//   BuildStore IN.laz... OUT.pfront
#include <LASFormat.h>
#include <pointfront/Build/StoreBuilder.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: BuildStore IN.laz... OUT.pfront\n");
    return 2;
  }
  const pointfront::LASFormat las;
  std::vector<std::unique_ptr<pointfront::PointSource>> sources;
  for (int i = 1; i + 1 < argc; ++i)
  {
    auto source = las.open(argv[i]);
    if (!source)
    {
      std::fprintf(stderr, "%s\n", source.error().what.c_str());
      return 1;
    }
    sources.push_back(std::move(source).value());
  }

  pointfront::BuildOptions options;
  options.outputPath = argv[argc - 1];
  options.overwrite = true;
  const auto report = pointfront::buildStore(sources, options,
    [](const pointfront::Progress& progress)
    {
      std::fprintf(stderr, "%s %3.0f %%\n", progress.phase, 100.0 * progress.fraction);
      return true; // false cancels, and leaves nothing behind
    });
  if (!report)
  {
    std::fprintf(stderr, "%s\n", report.error().what.c_str());
    return 1;
  }
  for (const std::string& warning : report->warnings)
  {
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  }
  std::printf("%llu points in %llu nodes, %llu bytes\n",
    static_cast<unsigned long long>(report->pointsStored),
    static_cast<unsigned long long>(report->nodes),
    static_cast<unsigned long long>(report->bytesWritten));
  return 0;
}
