#include "ErrorObserver.h"

#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontWriter.h"

#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

constexpr int count = 1000;

class Writer : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(testing::TempDir()) / ("pointfront-writer-" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkUnsignedShortArray> intensity;
    intensity->SetName("intensity");
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetName("RGBA");
    colours->SetNumberOfComponents(4);
    vtkNew<vtkFloatArray> heights;
    heights->SetName("elevation");
    vtkNew<vtkStringArray> names;
    names->SetName("names");
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(500000.0 + i % 40, 4649776.0 + i / 40, 0.25 * (i % 8));
      intensity->InsertNextValue(static_cast<unsigned short>(60000 - i));
      colours->InsertNextTuple4(i % 256, i / 256, 7, 255);
      heights->InsertNextValue(static_cast<float>(0.25 * (i % 8)));
      names->InsertNextValue("?");
    }
    data->SetPoints(points);
    for (vtkAbstractArray* array :
      { static_cast<vtkAbstractArray*>(intensity), static_cast<vtkAbstractArray*>(colours),
        static_cast<vtkAbstractArray*>(heights), static_cast<vtkAbstractArray*>(names) })
    {
      data->GetPointData()->AddArray(array);
    }
    writer->SetInputData(data);
    writer->SetFileName((folder / "points.pfront").c_str());
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPointFrontWriter> writer;
};

TEST_F(Writer, StoresPointsWithTheirData)
{
  writer->Write();
  ASSERT_EQ(writer->GetErrorCode(), vtkErrorCode::NoError);
  const auto store = pointfront::PointStore::open((folder / "points.pfront").string());
  ASSERT_TRUE(store.ok()) << store.error().what;
  const pointfront::StoreDescription& about = (*store)->description();
  EXPECT_EQ(about.pointCount, std::uint64_t(count));
  ASSERT_EQ(about.schema.size(), 2u) << "no z twice, no names";
  const auto intensity = about.schema.find("intensity");
  const auto rgb = about.schema.find("rgb");
  ASSERT_TRUE(intensity && rgb);
  EXPECT_EQ(about.schema[*intensity].type, pointfront::ScalarType::UInt16);
  EXPECT_EQ(about.schema[*rgb].components, 3);
  // Every point once, by its place.
  std::map<int, int> found;
  for (pointfront::NodeIndex node = 0; node < (*store)->hierarchy()->nodeCount(); ++node)
  {
    const auto columns = (*store)->read(node,
      { static_cast<std::uint32_t>(std::min(*intensity, *rgb)),
        static_cast<std::uint32_t>(std::max(*intensity, *rgb)) });
    ASSERT_TRUE(columns.ok());
    for (std::size_t i = 0; i < columns->size(); ++i)
    {
      const pointfront::GridPosition steps =
        columns->origin + pointfront::GridPosition(columns->positions[i]);
      const glm::dvec3 place = about.grid.toWorld(steps);
      const int number = static_cast<int>(std::lround(place.x - 500000.0)) +
        40 * static_cast<int>(std::lround(place.y - 4649776.0));
      ++found[number];
      EXPECT_NEAR(place.z, 0.25 * (number % 8), 1e-6);
      std::uint16_t value = 0;
      std::memcpy(&value, columns->columns[*intensity < *rgb ? 0 : 1].data() + 2 * i, 2);
      EXPECT_EQ(value, 60000 - number);
      unsigned char colour[3];
      std::memcpy(colour, columns->columns[*intensity < *rgb ? 1 : 0].data() + 3 * i, 3);
      EXPECT_EQ(colour[0], number % 256);
      EXPECT_EQ(colour[1], number / 256);
      EXPECT_EQ(colour[2], 7);
    }
  }
  EXPECT_EQ(found.size(), std::size_t(count));
}

TEST_F(Writer, SaysWhatItCannotWrite)
{
  writer->SetFileName("/proc/none/points.pfront");
  vtkObject::GlobalWarningDisplayOff();
  writer->Write();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(writer->GetErrorCode(), vtkErrorCode::CannotOpenFileError);
}

TEST_F(Writer, TellsThoseWhoObserveIt)
{
  writer->SetFileName(nullptr);
  vtkNew<ErrorObserver> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->Write();
  EXPECT_NE(errors->GetErrorMessage().find("no file name"), std::string::npos);
  EXPECT_EQ(writer->GetErrorCode(), unsigned(vtkErrorCode::NoFileNameError));
  errors->Clear();
  writer->SetFileName((folder / "nowhere" / "a.pfront").c_str());
  writer->Write();
  const std::string said = errors->GetErrorMessage();
  EXPECT_NE(said.find("nowhere"), std::string::npos) << said;
  EXPECT_EQ(said.find("vtkPointFrontBuilder"), std::string::npos) << said;
}

TEST_F(Writer, DoesNotReplaceAFileOfAnotherKind)
{
  const fs::path other = folder / "letter.pfront";
  std::ofstream(other) << "Dear reader";
  writer->SetFileName(other.c_str());
  vtkObject::GlobalWarningDisplayOff();
  writer->Write();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_NE(writer->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(fs::file_size(other), 11u);
}

} // namespace
