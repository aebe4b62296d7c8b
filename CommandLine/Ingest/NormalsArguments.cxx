#include "NormalsArguments.h"

#include "KnownWords.h"
#include "Values.h"

#include <limits>

namespace pointfront
{

void NormalsArguments::declare(CLI::App& app)
{
  app
    .add_option("--normals", method_,
      "Estimate normals: from planes through neighbours (pca; pcl: as the Point Cloud Library fits "
      "them) or neighbours in the scan (scanline) (none)")
    ->check(knownWords({ "none", "scanline", "pca", "pcl" }));
  CLI::Option* neighbours =
    app.add_option("--normals-k", neighbours_, "Neighbours of a plane, with the point itself (16)")
      ->check(CLI::Range(3u, 4096u))
      ->type_name("N");
  CLI::Option* radius =
    app.add_option("--normals-radius", radius_, "Instead: all points within that distance")
      ->check(numberBetween(std::numeric_limits<double>::min(), 1e9))
      ->type_name("METRES")
      ->excludes(neighbours);
  CLI::Option* eps = app.add_option("--normals-eps", eps_, "Error of an approximate search (0)")
                       ->check(numberBetween(0.0, 1000.0))
                       ->type_name("E");
  CLI::Option* curvature =
    app.add_flag("--curvature", curvature_, "Keep the curvature that PCA gives beside the normal");
  ofPCA_ = { neighbours, radius, eps, curvature };
  classesOption_ =
    app
      .add_option("--normals-classes", classes_, "Classes that get normals; others get none (all)")
      ->check([](const std::string& text)
        { return parseClasses(text) ? std::string() : "'" + text + "' is no list of classes"; })
      ->type_name("LIST");
}

void NormalsArguments::check() const
{
  for (const CLI::Option* option : ofPCA_)
  {
    if (option->count() > 0 && method_ != "pca" && method_ != "pcl")
    {
      throw CLI::ValidationError(option->get_name(), "needs --normals pca or pcl");
    }
  }
  if (classesOption_->count() > 0 && method_ == "none")
  {
    throw CLI::ValidationError(classesOption_->get_name(), "needs --normals");
  }
}

void NormalsArguments::fill(PassChoice& choice) const
{
  choice.normals = method_ == "none" ? PassChoice::Normals::None
    : method_ == "pca"               ? PassChoice::Normals::PCA
    : method_ == "pcl"               ? PassChoice::Normals::PCL
                                     : PassChoice::Normals::ScanLine;
  choice.normalsNeighbours = neighbours_;
  choice.normalsRadius = radius_;
  choice.normalsEps = eps_;
  choice.curvature = curvature_;
  if (classesOption_->count() > 0)
  {
    choice.normalsClasses = parseClasses(classes_);
  }
}

} // namespace pointfront
