#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>

using namespace pointfront;

namespace
{

/// Counts what a style tells its observers, and keeps the last error.
struct Observed
{
  Observed()
  {
    this->Callback->SetClientData(this);
    this->Callback->SetCallback(
      [](vtkObject*, unsigned long event, void* client, void* data)
      {
        auto* const self = static_cast<Observed*>(client);
        self->Changes += event == vtkCommand::ModifiedEvent ? 1 : 0;
        if (event == vtkCommand::ErrorEvent)
        {
          self->Error = static_cast<const char*>(data);
        }
      });
    this->Style->AddObserver(vtkCommand::ModifiedEvent, this->Callback);
    this->Style->AddObserver(vtkCommand::ErrorEvent, this->Callback);
  }

  vtkNew<vtkPointFrontStyle> Style;
  vtkNew<vtkCallbackCommand> Callback;
  int Changes = 0;
  std::string Error;
};

} // namespace

TEST(Style, ChangesAreToldOnceAndOnlyWhereSomethingChanges)
{
  Observed o;
  const auto before = o.Style->GetSharedStyleSheet();
  EXPECT_TRUE(o.Style->SetTechnique("splats"));
  EXPECT_EQ(o.Changes, 1);
  EXPECT_NE(o.Style->GetSharedStyleSheet(), before);
  EXPECT_FALSE(before->standard.technique) << "who keeps a sheet sees it unchanged";
  const auto after = o.Style->GetSharedStyleSheet();
  EXPECT_TRUE(o.Style->SetTechnique("splats"));
  EXPECT_EQ(o.Changes, 1);
  EXPECT_EQ(o.Style->GetSharedStyleSheet(), after);
}

TEST(Style, ClassesInheritWhatTheyDoNotSay)
{
  vtkNew<vtkPointFrontStyle> style;
  EXPECT_EQ(style->GetTechnique(), "points");
  EXPECT_EQ(style->GetColor(), "\"auto\"");
  style->SetTechnique("spheres");
  style->SetTechnique("ewa", 6);
  style->SetColor("intensity");
  style->SetColor(R"({"attribute": "local_height", "map": "viridis", "range": [0, 20]})", 5);
  style->SetOpacity(0.5);
  style->SetVisibility(false, 9);
  style->SetFilter("\"my value\" < 5");
  style->SetFilter("z < 50", 6);
  EXPECT_TRUE(style->SetEpoch("2024-07"));
  EXPECT_TRUE(style->SetEpoch("2019", 6));
  style->SetSizePixels(3.0, 6);
  EXPECT_EQ(style->GetTechnique(5), "spheres");
  EXPECT_EQ(style->GetTechnique(6), "ewa");
  EXPECT_EQ(style->GetColor(6), "\"intensity\"");
  EXPECT_EQ(
    style->GetColor(5), R"({"attribute":"local_height","map":"viridis","range":[0.0,20.0]})");
  EXPECT_EQ(style->GetOpacity(6), 0.5);
  EXPECT_TRUE(style->GetVisibility());
  EXPECT_FALSE(style->GetVisibility(9));
  EXPECT_EQ(style->GetFilter(6), "z < 50");
  EXPECT_EQ(style->GetEpoch(6), "2019");
  EXPECT_TRUE(style->ShowAllEpochs(6));
  EXPECT_EQ(style->GetEpoch(6), "2024-07");
  EXPECT_EQ(style->GetSize(6), R"({"mode":"fixed","px":3.0})");
  style->ResetClass(6);
  EXPECT_EQ(style->GetTechnique(6), "spheres");
  style->Reset();
  EXPECT_EQ(style->SaveJSON(), "{}");
}

TEST(Style, OutlinesAndWallsHaveTheirColours)
{
  vtkNew<vtkPointFrontStyle> style;
  EXPECT_EQ(style->GetRimColor(), "#000000");
  EXPECT_EQ(style->GetWallColorUpper(), "");
  EXPECT_TRUE(style->SetTechnique("silhouettes"));
  EXPECT_TRUE(style->SetRimColor("#102030"));
  EXPECT_TRUE(style->SetTechnique("solid", 6));
  EXPECT_TRUE(style->SetWallColor("#808080", "#404040", 6));
  EXPECT_EQ(style->GetRimColor(6), "#102030");
  EXPECT_EQ(style->GetWallColorUpper(6), "#808080");
  EXPECT_EQ(style->GetWallColorLower(6), "#404040");
  vtkNew<vtkPointFrontStyle> other;
  EXPECT_TRUE(other->LoadJSON(style->SaveJSON()));
  EXPECT_EQ(other->GetWallColorLower(6), "#404040");
  EXPECT_EQ(other->GetRimColor(), "#102030");
  EXPECT_TRUE(style->SetWallColor("", "", 6));
  EXPECT_EQ(style->GetWallColorLower(6), "");
}

TEST(Style, WhatIsWrongIsAnErrorAndChangesNothing)
{
  Observed o;
  EXPECT_FALSE(o.Style->SetTechnique("dots"));
  EXPECT_NE(o.Error.find("'dots' is unknown: use points"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetTechnique("facade", 6));
  EXPECT_NE(o.Error.find("class 6"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetRimColor("black"));
  EXPECT_NE(o.Error.find("'black' is no colour"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetWallColor("#808080", "", 6));
  EXPECT_NE(o.Error.find("class 6"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetColor("#12"));
  EXPECT_FALSE(o.Style->SetColor("{\"attribute\": 3}"));
  EXPECT_FALSE(o.Style->SetColor("{\"attribute\": \"a\"}, \"opacity\": 0"));
  EXPECT_FALSE(o.Style->SetOpacity(1.5));
  EXPECT_FALSE(o.Style->SetSizeWorld(-1.0));
  EXPECT_FALSE(o.Style->SetVisibility(false, 256));
  EXPECT_FALSE(o.Style->SetFilter("z = 3"));
  EXPECT_NE(o.Error.find("character 3"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetCommonFilter("z <"));
  EXPECT_FALSE(o.Style->SetEyeDomeStrength(-1.0));
  EXPECT_FALSE(o.Style->LoadJSON(R"({"classes": {"6": {"size": {"mode": "big"}}}})"));
  EXPECT_NE(o.Error.find("classes.6.size.mode"), std::string::npos) << o.Error;
  EXPECT_EQ(o.Changes, 0);
  EXPECT_EQ(o.Style->GetStyleSheet(), StyleSheet());
}

TEST(Style, TextGoesInAndComesOut)
{
  Observed o;
  ASSERT_TRUE(o.Style->LoadJSON(
    R"({"default": {"technique": "splats"}, "classes": {"9": {"visible": false}},
        "where": "z < 3", "shading": {"mode": ["lit", "edl"], "strength": 0.7}})"));
  EXPECT_EQ(o.Changes, 1);
  EXPECT_EQ(o.Style->GetCommonFilter(), "z < 3");
  EXPECT_TRUE(o.Style->GetLit());
  EXPECT_FLOAT_EQ(static_cast<float>(o.Style->GetEyeDomeStrength()), 0.7f);
  vtkNew<vtkPointFrontStyle> other;
  ASSERT_TRUE(other->LoadJSON(o.Style->SaveJSON()));
  EXPECT_EQ(other->GetStyleSheet(), o.Style->GetStyleSheet());
  std::ostringstream printed;
  other->Print(printed);
  EXPECT_NE(printed.str().find("\"technique\": \"splats\""), std::string::npos);
}

TEST(Style, LightAndEyeDomeLightingBelongToAClass)
{
  Observed o;
  EXPECT_FALSE(o.Style->GetLit());
  ASSERT_TRUE(o.Style->SetTechnique("spheres", 5));
  EXPECT_TRUE(o.Style->GetLit(5)) << "spheres are lit";
  ASSERT_TRUE(o.Style->SetAmbient(0.1, 5));
  EXPECT_TRUE(o.Style->GetLit(5)) << "and stay so";
  EXPECT_NEAR(o.Style->GetAmbient(5), 0.1, 1e-6);
  EXPECT_NEAR(o.Style->GetAmbient(), 0.3, 1e-6);
  ASSERT_TRUE(o.Style->SetLit(false, 5));
  EXPECT_FALSE(o.Style->GetLit(5));
  ASSERT_TRUE(o.Style->SetEyeDomeStrength(0.4));
  ASSERT_TRUE(o.Style->SetEyeDomeStrength(0.0, 6));
  ASSERT_TRUE(o.Style->SetEyeDomeRadius(3.0, 2));
  EXPECT_NEAR(o.Style->GetEyeDomeStrength(2), 0.4, 1e-6);
  EXPECT_EQ(o.Style->GetEyeDomeRadius(2), 3.0);
  EXPECT_EQ(o.Style->GetEyeDomeRadius(), 1.0);
  EXPECT_EQ(o.Style->GetEyeDomeStrength(6), 0.0);
  vtkNew<vtkPointFrontStyle> other;
  ASSERT_TRUE(other->LoadJSON(o.Style->SaveJSON()));
  EXPECT_EQ(other->GetStyleSheet(), o.Style->GetStyleSheet());
  EXPECT_FALSE(o.Style->SetDiffuse(-0.1, 6));
  EXPECT_NE(o.Error.find("class 6: diffuse light is from 0 to 10"), std::string::npos) << o.Error;
  EXPECT_FALSE(o.Style->SetLit(true, 256));
}

TEST(Style, LensesAreNumberedMovedAndStyled)
{
  Observed o;
  EXPECT_EQ(o.Style->AddCircleLens(100, 50, 30), 0);
  EXPECT_EQ(o.Style->AddClassLens(6, 2.5), 1);
  EXPECT_EQ(o.Style->GetNumberOfLenses(), 2);
  EXPECT_TRUE(o.Style->SetLensStyle(0, R"({"visible": false})", 5));
  EXPECT_TRUE(o.Style->SetLensStyle(0, R"({"color": "intensity"})"));
  EXPECT_EQ(o.Style->GetLensStyle(0, 5), R"({"visible":false})");
  EXPECT_EQ(o.Style->GetLensStyle(0), R"({"color":"intensity"})");
  EXPECT_EQ(o.Style->GetLensStyle(0, 7), "{}");
  o.Changes = 0;
  EXPECT_TRUE(o.Style->SetLensCenter(0, 7, 8));
  EXPECT_TRUE(o.Style->SetLensCenter(0, 7, 8));
  EXPECT_EQ(o.Changes, 1);
  EXPECT_EQ(o.Style->GetLensCenterX(0), 7.0);
  EXPECT_TRUE(o.Style->SetLensRadius(0, 60));
  EXPECT_EQ(o.Style->GetLensRadius(0), 60.0);
  EXPECT_TRUE(o.Error.empty());
  EXPECT_FALSE(o.Style->SetLensRadius(1, 60)) << "no circle";
  EXPECT_FALSE(o.Style->SetLensCenter(2, 0, 0));
  EXPECT_FALSE(o.Style->SetLensStyle(0, R"({"visible": false}, "classes": {})"));
  EXPECT_FALSE(o.Style->SetLensStyle(0, R"({"visibel": false})"));
  EXPECT_NE(o.Error.find("visibel"), std::string::npos);
  EXPECT_EQ(o.Style->AddCircleLens(0, 0, -1), -1);
  EXPECT_EQ(o.Style->AddClassLens(-1, 2), -1);
  EXPECT_EQ(o.Style->AddMaskLens(nullptr), -1);
  EXPECT_TRUE(o.Style->RemoveLens(0));
  EXPECT_EQ(o.Style->GetStyleSheet().lenses[0].aroundRadius, 2.5);
  o.Style->RemoveAllLenses();
  EXPECT_EQ(o.Style->GetNumberOfLenses(), 0);
}

TEST(Style, AMaskIsAnImage)
{
  Observed o;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int i = 0; i < 6; ++i)
  {
    image->SetScalarComponentFromDouble(i % 3, i / 3, 0, 0, i == 4 ? 255.0 : 0.0);
  }
  EXPECT_EQ(o.Style->AddMaskLens(image), 0);
  const FrameLens& lens = o.Style->GetStyleSheet().lenses[0].place;
  EXPECT_TRUE(lens.covers(45, 30, 90, 40)) << "the middle of the upper half";
  EXPECT_FALSE(lens.covers(45, 10, 90, 40));
}

TEST(Style, HighlightsAreOneAClass)
{
  Observed o;
  EXPECT_TRUE(o.Style->SetHighlight(6, "#ffcc00"));
  EXPECT_TRUE(o.Style->SetHighlight(6, "#00ccff", 5, 0));
  EXPECT_TRUE(o.Style->HasHighlight(6));
  ASSERT_EQ(o.Style->GetStyleSheet().highlights.size(), 1u);
  EXPECT_EQ(o.Style->GetStyleSheet().highlights[0].haloPx, 5.0f);
  EXPECT_FALSE(o.Style->SetHighlight(6, "yellow"));
  EXPECT_FALSE(o.Style->SetHighlight(6, "#ffcc00", 1000));
  EXPECT_FALSE(o.Style->SetHighlight(-1, "#ffcc00"));
  EXPECT_TRUE(o.Style->RemoveHighlight(6));
  EXPECT_FALSE(o.Style->RemoveHighlight(6));
}
