// usage: pointfrontRasterBenchmark [--only TECHNIQUE] STORE [PICTURE_FOLDER [X Y Z FX FY FZ ANGLE]]
//
// Draws every point of a store with each technique of the software rasteriser: nanoseconds of CPU
// and of the clock a point, by one thread and by two, the best and the median of some frames.
// One thread and two take turns, so that other users of the machine slow both down.
// Everything is in memory before; a frame is all from clearing to the resolved colours and depths.
// A folder gets a picture of each.

#include "SoftwareRasteriser.h"

#include "PNGWriter.h"
#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;

constexpr int frames = 15;
constexpr int width = 1280;
constexpr int height = 720;

struct MeasuredTechnique
{
  const char* name;
  Technique technique;
  bool blended;
  bool normals;
  SplatAccuracy accuracy;
  SplatSize size;
};

const SplatSize onePixel{ SplatSize::Mode::Pixels, 1.0, 0 };
const SplatSize spacing{ SplatSize::Mode::Spacing, 1.0, 0 };

const MeasuredTechnique techniques[] = {
  { "points_1px", Technique::Points, false, false, SplatAccuracy::Affine, onePixel },
  { "points_3px", Technique::Points, false, false, SplatAccuracy::Affine,
    { SplatSize::Mode::Pixels, 3.0, 0 } },
  { "flat_discs", Technique::Points, false, false, SplatAccuracy::Affine, spacing },
  { "paraboloids", Technique::Splats, false, false, SplatAccuracy::Affine, spacing },
  { "ellipses", Technique::Splats, false, true, SplatAccuracy::Affine, spacing },
  { "spheres", Technique::Spheres, false, false, SplatAccuracy::Affine, spacing },
  { "silhouettes", Technique::Silhouettes, false, true, SplatAccuracy::Affine, spacing },
  { "solid", Technique::Solid, false, true, SplatAccuracy::Affine, spacing },
  { "blended_paraboloids", Technique::Splats, true, false, SplatAccuracy::Affine, spacing },
  { "ewa_affine", Technique::Ewa, true, true, SplatAccuracy::Affine, spacing },
  { "ewa_exact", Technique::Ewa, true, true, SplatAccuracy::Exact, spacing },
  { "ewa_full", Technique::Ewa, true, true, SplatAccuracy::Full, spacing },
};

double seconds(clockid_t clock)
{
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

[[noreturn]] void fail(const std::string& why)
{
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);
}

std::vector<std::shared_ptr<const NodeColumns>> readAll(
  const PointStore& store, const ColumnSelection& columns)
{
  std::vector<std::shared_ptr<const NodeColumns>> nodes;
  for (NodeIndex node = 0; node < store.hierarchy()->nodeCount(); ++node)
  {
    Result<NodeColumns> read = store.read(node, columns);
    if (!read)
    {
      fail(read.error().what);
    }
    nodes.push_back(std::make_shared<const NodeColumns>(std::move(read).value()));
  }
  return nodes;
}

void save(const std::string& path, const SoftwareTarget& target)
{
  auto writer = PNGWriter::create(
    path, { std::uint32_t(width), std::uint32_t(height) }, PNGWriter::Pixels::RGBA8);
  const auto* const last =
    reinterpret_cast<const std::uint8_t*>(&target.rgba[std::size_t(height - 1) * width]);
  if (!writer || !(*writer)->append(last, height, -4 * width) || !(*writer)->finish())
  {
    fail(path + " could not be written");
  }
}

/// One number of threads and what its frames take.
struct Measured
{
  explicit Measured(unsigned threads)
    : crew(threads)
    , rasteriser(&crew)
  {
  }
  void draw(const FramePlan& plan, SoftwareTarget& target)
  {
    target.reset(width, height);
    const double cpuBefore = seconds(CLOCK_PROCESS_CPUTIME_ID), before = seconds(CLOCK_MONOTONIC);
    if (rasteriser.draw(plan, target).reused > 0)
    {
      fail("a frame was not drawn anew");
    }
    cpu = std::min(cpu, seconds(CLOCK_PROCESS_CPUTIME_ID) - cpuBefore);
    wall.push_back(seconds(CLOCK_MONOTONIC) - before);
  }
  double median() const
  {
    std::vector<double> sorted = wall;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

  ThreadCrew crew;
  SoftwareRasteriser rasteriser;
  double cpu = 1e30;
  std::vector<double> wall;
};

/// A line of the table.
void measure(const char* name, const FramePlan& plan, SoftwareTarget& target)
{
  Measured alone(1), both(2);
  for (int frame = 0; frame < frames; ++frame)
  {
    FramePlan turned = plan;
    turned.camera.viewToClip[2][2] *= 1.0 + 1e-9 * frame; // another view: nothing is reused
    alone.draw(turned, target);
    both.draw(turned, target);
  }
  const auto points = static_cast<double>(plan.pointCount());
  std::printf("| %s | %.2f | %.2f | %.1f | %.1f | %.2f |\n", name, 1e9 * alone.cpu / points,
    1e9 * both.cpu / points, 1e3 * alone.median(), 1e3 * both.median(),
    alone.median() / both.median());
  std::fflush(stdout);
}

/// All points of all nodes, as if nothing were finer: what closes a leaf closes all above it.
FramePlan planOfAll(const StoreDescription& description,
  const std::vector<std::shared_ptr<const NodeColumns>>& nodes, int argc, char** argv)
{
  FramePlan plan;
  const Bounds& box = description.bounds;
  const glm::dvec3 middle = 0.5 * (box.low + box.high);
  const double size = glm::length(box.high - box.low);
  glm::dvec3 from = middle + glm::dvec3(-0.35, -0.45, 0.35) * size;
  glm::dvec3 at = middle;
  double angle = 45.0;
  if (argc == 10)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::atof(argv[3 + axis]);
      at[axis] = std::atof(argv[6 + axis]);
    }
    angle = std::atof(argv[9]);
  }
  plan.camera = FrameCamera::perspective(
    from, at, { 0, 0, 1 }, angle * 0.017453292519943295, 1e-4 * size, 10.0 * size, width, height);
  plan.grid = description.grid;
  plan.schema = std::make_shared<const AttributeSchema>(description.schema);
  plan.splatRadiusBase = description.splatRadiusBase;
  plan.batches.resize(1);
  float finest = 1e30f;
  for (const auto& node : nodes)
  {
    finest = node->leaf && node->size() > 0 ? std::min(finest, node->spacing) : finest;
  }
  for (const auto& node : nodes)
  {
    PlanItem item;
    item.node = node;
    item.last = static_cast<std::uint32_t>(node->size());
    item.refined = !node->leaf;
    item.closingRadius = node->leaf && node->splatRadius > 0.0f ? node->splatRadius : finest;
    plan.batches[0].items.push_back(std::move(item));
  }
  return plan;
}

std::optional<std::uint32_t> columnOf(const StoreDescription& description, const char* name)
{
  const auto found = description.schema.find(name);
  return found ? std::optional<std::uint32_t>(static_cast<std::uint32_t>(*found)) : std::nullopt;
}

/// Columns of a store that techniques draw by.
struct DrawnColumns
{
  explicit DrawnColumns(const StoreDescription& description)
    : rgb(columnOf(description, "rgb"))
    , normal(columnOf(description, "normal"))
    , radius(columnOf(description, splatRadiusAttribute))
    , height(columnOf(description, "height_above_ground"))
    , wide(rgb && description.ranges[*rgb].components[0][1] > 255.0)
  {
  }

  ColumnSelection all() const
  {
    ColumnSelection columns;
    for (const auto& one : { rgb, normal, radius, height })
    {
      if (one)
      {
        columns.push_back(*one);
      }
    }
    std::sort(columns.begin(), columns.end());
    return columns;
  }

  std::optional<std::uint32_t> rgb, normal, radius, height;
  bool wide; ///< colours have more than 8 bits
};

/// None if the store lacks a column that the technique needs.
std::shared_ptr<const ResolvedStyle> styleOf(
  const MeasuredTechnique& one, const DrawnColumns& columns)
{
  const bool solid = one.technique == Technique::Solid;
  if ((one.normals && !columns.normal) || (solid && !columns.height))
  {
    return nullptr;
  }
  auto style = std::make_shared<ResolvedStyle>();
  style->technique = one.technique;
  style->blended = one.blended;
  style->accuracy = one.accuracy;
  style->size = one.size;
  style->normalColumn = one.normals ? columns.normal : std::nullopt;
  style->radiusColumn = columns.radius;
  style->heightColumn = solid ? columns.height : std::nullopt;
  style->colouring.kind = columns.rgb ? PointColouring::Kind::Direct : PointColouring::Kind::Flat;
  style->colouring.column = columns.rgb.value_or(0);
  style->colouring.wide = columns.wide;
  return style;
}

} // namespace

int main(int argc, char** argv)
{
  std::string only;
  if (argc > 3 && std::string(argv[1]) == "--only")
  {
    only = argv[2];
    argc -= 2;
    argv += 2;
  }
  if (argc != 2 && argc != 3 && argc != 10)
  {
    fail("usage: pointfrontRasterBenchmark [--only TECHNIQUE] STORE "
         "[PICTURE_FOLDER [X Y Z FX FY FZ ANGLE]]");
  }
  const Result<std::shared_ptr<const PointStore>> opened = PointStore::open(argv[1]);
  if (!opened)
  {
    fail(opened.error().what);
  }
  const PointStore& store = **opened;
  const StoreDescription& description = store.description();
  const DrawnColumns columns(description);
  const auto nodes = readAll(store, columns.all());

  FramePlan plan = planOfAll(description, nodes, argc, argv);
  std::printf("%llu points, %zu nodes, %s\n", static_cast<unsigned long long>(plan.pointCount()),
    nodes.size(), SoftwareRasteriser().instructionSet());
  std::printf("| technique | CPU ns a point, 1 thread | 2 threads "
              "| ms, 1 thread | 2 threads | speed-up |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const MeasuredTechnique& one : techniques)
  {
    const auto style = styleOf(one, columns);
    if (!style || (!only.empty() && only != one.name))
    {
      continue;
    }
    plan.batches[0].style = style;
    SoftwareTarget target;
    measure(one.name, plan, target);
    if (argc > 2)
    {
      save(std::string(argv[2]) + "/" + one.name + ".png", target);
    }
  }
  return 0;
}
