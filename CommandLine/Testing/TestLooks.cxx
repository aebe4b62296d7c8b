#include "ClassList.h"
#include "Distance.h"
#include "Looks.h"
#include "PickedPoint.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace pointfront
{

TEST(Looks, KeysGoRoundTheTechniquesAndBack)
{
  Looks looks{ DrawingOptions() };
  std::vector<std::string> said;
  for (int i = 0; i < 6; ++i)
  {
    said.push_back(looks.obey(KeyAction::NextTechnique).value());
  }
  EXPECT_EQ(said.front(), "technique splats");
  EXPECT_EQ(said.back(), "technique points");
  EXPECT_EQ(looks.obey(KeyAction::LastTechnique), said[4]);
  EXPECT_EQ(looks.obey(KeyAction::Quit), std::nullopt);
}

TEST(Looks, PresetsFollowEachOtherAndBeginAnewAfterAChange)
{
  Looks looks{ DrawingOptions() };
  EXPECT_EQ(looks.obey(KeyAction::NextQuality), "quality draft: splats, error 2 px");
  EXPECT_EQ(looks.drawing().errorPx, 2.0);
  EXPECT_EQ(looks.obey(KeyAction::NextQuality), "quality balanced: splats, error 1 px");
  EXPECT_EQ(looks.obey(KeyAction::NextQuality), "quality exact: ewa, error 0.5 px");
  looks.obey(KeyAction::NextTechnique);
  EXPECT_EQ(looks.obey(KeyAction::NextQuality), "quality draft: splats, error 2 px");
}

TEST(Looks, SizesStayWithinWhatCanBeDrawn)
{
  DrawingOptions drawing;
  drawing.pointSizePx = 4.0;
  drawing.style.standard.size = StyleSize{ SplatSize::Mode::Pixels, 4.0, "" };
  Looks looks{ drawing };
  for (int i = 0; i < 100; ++i)
  {
    looks.obey(KeyAction::Larger);
  }
  EXPECT_EQ(looks.drawing().pointSizePx, 255.0);
  for (int i = 0; i < 100; ++i)
  {
    looks.obey(KeyAction::Smaller);
  }
  EXPECT_EQ(looks.drawing().pointSizePx, 1.0);
  EXPECT_EQ(looks.drawing().style.standard.size->value, 1.0);
}

TEST(Distance, HasALengthAndAHeight)
{
  const Distance distance{ { 1.0, 2.0, 10.0 }, { 4.0, 6.0, -2.0 } };
  EXPECT_EQ(distance.length(), 13.0);
  EXPECT_EQ(distance.horizontal(), 5.0);
  EXPECT_EQ(distance.height(), -12.0);
  EXPECT_NE(textOf(distance).find("-12.000"), std::string::npos);
  EXPECT_EQ(jsonOf(distance)["to"][1], 6.0);
}

TEST(PickedPoint, TellsItsClassInWords)
{
  PickedPoint point;
  point.position = { 1.0, 2.0, 3.5 };
  point.attributes["classification"] = 6;
  point.attributes["rgb"] = { 10, 20, 30 };
  EXPECT_EQ(
    textOf(point), "1.000 2.000 3.500\nclassification 6 building\nrgb            10 20 30\n");
  EXPECT_EQ(jsonOf(point)["rgb"][2], 30);
}

TEST(PickedPoint, AttributesDoNotTakeThePlaceOfItsNameNumberAndPlace)
{
  PickedPoint point;
  point.store = "a.pfront";
  point.id = 3;
  point.position = { 1.0, 2.0, 3.5 };
  for (const char* const name : { "store", "id", "x", "y", "z" })
  {
    point.attributes[name] = 7;
  }
  const nlohmann::ordered_json told = jsonOf(point);
  EXPECT_EQ(told["store"], "a.pfront");
  EXPECT_EQ(told["id"], 3);
  EXPECT_EQ(told["z"], 3.5);
  for (const char* const name : { "store_", "id_", "x_", "y_", "z_" })
  {
    EXPECT_EQ(told.value(name, 0), 7) << name;
  }
}

} // namespace pointfront
