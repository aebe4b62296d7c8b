#include "StyledStore.h"

#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include <gtest/gtest.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{
std::shared_ptr<const ResolvedStyle> resolvedIn(
  const StoreDescription& store, const StyleSheet& sheet)
{
  const auto style = sheet.resolve(store, 0);
  EXPECT_TRUE(style) << (style ? "" : style.error().what);
  return style ? *style : nullptr;
}
} // namespace

/// Attributes that nodes compute while they load are read for who is worth it, or names them.
TEST(ComputedNormals, AreForEwaForLightAndForWhoNamesThem)
{
  StoreDescription store = styledStore({ 2 });
  store.computed = { normalsColumn };
  StyleSheet sheet;
  sheet.standard.size = StyleSize{ SplatSize::Mode::Pixels, 2.0, "" };
  sheet.standard.colour = ColourSource::ofConstant({ 1, 2, 3, 255 });
  const auto columns = [&](Technique technique)
  {
    sheet.standard.technique = technique;
    return resolvedIn(store, sheet)->columns();
  };
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    if (traits.technique == Technique::Solid)
    {
      continue; // reads heights
    }
    sheet.shading.lit = false;
    const bool ewa = traits.technique == Technique::Ewa;
    EXPECT_EQ(columns(traits.technique), ewa ? ColumnSelection{ normalsColumn } : ColumnSelection{})
      << traits.name;
    sheet.shading.lit = true;
    const bool spheres = traits.technique == Technique::Spheres; // have their own
    EXPECT_EQ(
      columns(traits.technique), spheres ? ColumnSelection{} : ColumnSelection{ normalsColumn })
      << traits.name;
  }
  sheet.shading.lit = false;
  sheet.standard.orientation = StyleOrientation{ SplatOrientation::Normal, {} };
  EXPECT_EQ(columns(Technique::Splats), ColumnSelection{ normalsColumn });
  sheet.standard.orientation = StyleOrientation{ SplatOrientation::View, {} };
  EXPECT_EQ(columns(Technique::Ewa), ColumnSelection{});
  sheet.standard.orientation.reset();
  sheet.standard.where = *FilterExpression::parse("normal.z > 0.5");
  EXPECT_EQ(columns(Technique::Splats), ColumnSelection{ normalsColumn });
  EXPECT_FALSE(resolvedIn(store, sheet)->normalColumn);
}
