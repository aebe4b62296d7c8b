#include "HeightArguments.h"

#include "Values.h"

namespace pointfront
{
namespace
{
// Cells of positions up to 1e12 can be numbered.
const CLI::Validator lengths = numberBetween(1e-3, 1e6);
} // namespace

void HeightArguments::declare(CLI::App& app)
{
  CLI::Option* local = app.add_flag("--local-height", local_,
    "Attribute local_height: height above the mean of the same class nearby");
  app.add_option("--local-height-radius", localRadius_, "What is nearby, horizontally (5)")
    ->check(lengths)
    ->type_name("METRES")
    ->needs(local);
  CLI::Option* ground = app.add_flag("--height-above-ground", aboveGround_,
    "Attribute height_above_ground: from class 2, or the lowest points when there is none");
  app
    .add_option("--ground-cell", groundCell_,
      "Cells whose lowest points are the ground when no point is of class 2 (10)")
    ->check(lengths)
    ->type_name("METRES")
    ->needs(ground);
}

void HeightArguments::fill(PassChoice& choice) const
{
  choice.localHeight = local_;
  choice.localHeightRadius = localRadius_;
  choice.heightAboveGround = aboveGround_;
  choice.groundCell = groundCell_;
}

} // namespace pointfront
