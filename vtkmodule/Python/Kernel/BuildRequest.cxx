#include "BuildRequest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace pointfront
{
namespace
{

/// The bytes that a text's code points are, U+0000 to U+00FF.
std::string bytesOf(const std::string& text)
{
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const auto first = static_cast<unsigned char>(text[i]);
    const bool pair = first >= 0xc0 && i + 1 < text.size();
    const unsigned next = pair ? static_cast<unsigned char>(text[++i]) & 0x3fU : 0U;
    bytes += static_cast<char>(pair ? ((first & 0x03U) << 6U) | next : first);
  }
  return bytes;
}

nlohmann::json withBytes(const nlohmann::json& value)
{
  if (value.is_string())
  {
    return bytesOf(value.get<std::string>());
  }
  nlohmann::json made = value;
  if (value.is_structured())
  {
    for (auto item = made.begin(); item != made.end(); ++item)
    {
      *item = withBytes(*item);
    }
  }
  return made;
}

/// The value of that name; a type of JSON that is another one throws.
template <typename T>
T valueOf(const nlohmann::json& request, const char* name, const T& otherwise)
{
  return request.value(name, otherwise);
}

BuildOptions optionsOf(const nlohmann::json& request)
{
  BuildOptions options;
  options.outputPath = valueOf(request, "output", std::string());
  options.temporaryFolder = valueOf(request, "temporary_folder", std::string());
  options.overwrite = valueOf(request, "overwrite", false);
  options.onFault = valueOf(request, "skip_faulty", false) ? OnFault::Skip : OnFault::Stop;
  options.memoryBytes = valueOf(request, "memory_limit", options.memoryBytes);
  options.threads = valueOf(request, "number_of_threads", options.threads);
  options.nodePoints = valueOf(request, "node_points", options.nodePoints);
  options.structure = valueOf(request, "structure", std::string()) == "kdtree" ? Structure::KdTree
                                                                               : Structure::Octree;
  options.refinement = valueOf(request, "refinement", std::string()) == "replace"
    ? Refinement::Replace
    : Refinement::Add;
  const auto layers = valueOf(request, "layers", std::string("auto"));
  options.layering = layers == "class" ? Layering::ObjectClass
    : layers == "none"                 ? Layering::None
                                       : Layering::Automatic;
  const int depth = valueOf(request, "color_depth", 0);
  options.colourDepth = depth == 8 ? ColourDepth::Eight
    : depth == 16                  ? ColourDepth::Sixteen
                                   : ColourDepth::ByFile;
  if (const double precision = valueOf(request, "precision", 0.0); precision > 0.0)
  {
    options.precision = precision;
  }
  if (request.contains("attributes"))
  {
    options.attributes = request.at("attributes").get<std::vector<std::string>>();
  }
  return options;
}

PassChoice passesOf(const nlohmann::json& request)
{
  PassChoice choice;
  choice.targetCrs = valueOf(request, "crs", std::string());
  choice.assumedCrs = valueOf(request, "assumed_crs", std::string());
  choice.targetCrsName = "crs";
  choice.assumedCrsName = "assumed_crs";
  choice.colourFrom = valueOf(request, "color_from", choice.colourFrom);
  choice.attributeFrom = valueOf(request, "attribute_from", choice.attributeFrom);
  const auto normals = valueOf(request, "normals", std::string());
  choice.normals = normals == "pca" ? PassChoice::Normals::PCA
    : normals == "scanline"         ? PassChoice::Normals::ScanLine
                                    : PassChoice::Normals::None;
  choice.normalsNeighbours = valueOf(request, "normals_neighbors", choice.normalsNeighbours);
  choice.normalsRadius = valueOf(request, "normals_radius", choice.normalsRadius);
  choice.normalsEps = valueOf(request, "normals_error", choice.normalsEps);
  choice.curvature = valueOf(request, "curvature", choice.curvature);
  choice.splatRadius = valueOf(request, "splat_radius", choice.splatRadius);
  if (request.contains("normals_classes"))
  {
    choice.normalsClasses = request.at("normals_classes").get<std::vector<std::uint8_t>>();
    std::sort(choice.normalsClasses->begin(), choice.normalsClasses->end());
  }
  choice.localHeight = valueOf(request, "local_height", choice.localHeight);
  choice.localHeightRadius = valueOf(request, "local_height_radius", choice.localHeightRadius);
  choice.heightAboveGround = valueOf(request, "height_above_ground", choice.heightAboveGround);
  choice.groundCell = valueOf(request, "ground_cell", choice.groundCell);
  return choice;
}

} // namespace

BuildOrder buildOrderOf(const char* text)
{
  const nlohmann::json request = withBytes(nlohmann::json::parse(text));
  BuildOrder order;
  order.files = valueOf(request, "files", order.files);
  std::sort(order.files.begin(), order.files.end());
  order.options = optionsOf(request);
  order.passes = passesOf(request);
  if (request.contains("box"))
  {
    const auto box = request.at("box").get<std::array<double, 6>>();
    order.box = Bounds{ { box[0], box[1], box[2] }, { box[3], box[4], box[5] } };
  }
  order.preview.wanted = valueOf(request, "preview", order.preview.wanted);
  order.preview.leastPoints = valueOf(request, "preview_points", order.preview.leastPoints);
  return order;
}

} // namespace pointfront
