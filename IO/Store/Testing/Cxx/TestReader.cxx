#include "BuiltStore.h"
#include "ErrorObserver.h"
#include "TestBuildClouds.h"

#include "pointfront/Store/PointStore.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkElevationFilter.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <set>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Hills of `count` points with 16-bit colour, a scaled attribute and the input's index.
std::string storeOf(const std::string& name, std::size_t count)
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  schema.add({ "id", ScalarType::UInt32, 1 });
  schema.add({ "height", ScalarType::Int16, 1, 0.5, 100.0 });
  auto cloud = std::make_unique<CloudSource>(name, schema, millimetres({ 5e5, 4e6, 0.0 }));
  Random random(3);
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud->addPosition(glm::dvec3(5e5, 4e6, 0.0) +
      glm::dvec3(100.0 * random.uniform(), 100.0 * random.uniform(), random.uniform()));
    cloud->addValue(
      0, std::array<std::uint16_t, 3>{ static_cast<std::uint16_t>(i & 0xffff), 0x8000, 0xffff });
    cloud->addValue(1, static_cast<std::uint32_t>(i));
    cloud->addValue(2, static_cast<std::int16_t>(i % 100));
  }
  return builtStore(name, std::move(cloud), nodesOf(500));
}

TEST(Reader, InformationHasTheBoundsAndTheArraysButNoPoints)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("information", 5000).c_str());
  EXPECT_EQ(reader->GetStore(), nullptr);
  reader->UpdateInformation();
  ASSERT_NE(reader->GetStore(), nullptr);
  double bounds[6];
  reader->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::BOUNDS(), bounds);
  EXPECT_GE(bounds[0], 5e5);
  EXPECT_LE(bounds[1], 5e5 + 100.0);
  EXPECT_GT(bounds[1] - bounds[0], 99.0);
  EXPECT_EQ(reader->GetNumberOfPointArrays(), 3);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Reader, TheOverviewOfAllPointsIsTheCloud)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("all", 5000).c_str());
  reader->Update();
  vtkPolyData* output = reader->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 5000);
  EXPECT_EQ(output->GetNumberOfVerts(), 5000);
  EXPECT_EQ(output->GetPoints()->GetDataType(), VTK_DOUBLE);
  auto* id = output->GetPointData()->GetArray("id");
  auto* height = output->GetPointData()->GetArray("height");
  auto* rgb = output->GetPointData()->GetScalars();
  ASSERT_TRUE(id && height && rgb);
  EXPECT_STREQ(rgb->GetName(), "rgb");
  EXPECT_EQ(rgb->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(height->GetDataType(), VTK_DOUBLE);
  std::set<vtkIdType> all;
  Random random(3);
  std::vector<glm::dvec3> input;
  for (int i = 0; i < 5000; ++i)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    input.emplace_back(5e5 + 100.0 * x, 4e6 + 100.0 * y, random.uniform());
  }
  for (vtkIdType i = 0; i < 5000; ++i)
  {
    const auto index = static_cast<std::size_t>(id->GetTuple1(i));
    double p[3];
    output->GetPoint(i, p);
    EXPECT_NEAR(p[1], input[index].y, 0.00051);
    EXPECT_DOUBLE_EQ(height->GetTuple1(i), 100.0 + 0.5 * static_cast<double>(index % 100));
    EXPECT_EQ(rgb->GetComponent(i, 0), static_cast<double>(index >> 8));
    EXPECT_EQ(rgb->GetComponent(i, 1), 128.0);
    all.insert(static_cast<vtkIdType>(output->GetPointData()->GetGlobalIds()->GetTuple1(i)));
  }
  EXPECT_EQ(all.size(), 5000u);
  EXPECT_EQ(*all.begin(), 0);
  EXPECT_EQ(*all.rbegin(), 4999);
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(output), reader->GetStore()->GetFileName());
}

TEST(Reader, AnOverviewIsAsLargeAsAskedAndHasNoThinQuarter)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("overview", 20000).c_str());
  reader->SetOverviewPoints(3000);
  reader->Update();
  EXPECT_LE(reader->GetOutput()->GetNumberOfPoints(), 3000);
  EXPECT_GT(reader->GetOutput()->GetNumberOfPoints(), 2500);
  std::array<int, 4> quarters{};
  for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double p[3];
    reader->GetOutput()->GetPoint(i, p);
    ++quarters[(p[0] > 5e5 + 50.0 ? 1 : 0) + (p[1] > 4e6 + 50.0 ? 2 : 0)];
  }
  for (const int count : quarters)
  {
    EXPECT_NEAR(count, 750, 250);
  }
  reader->SetOverviewPoints(0);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(vtkPointFrontStore::GetStoreName(reader->GetOutput()), "");
}

TEST(Reader, PiecesHaveEachPointOnce)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("pieces", 20000).c_str());
  reader->SetOverviewPoints(100000);
  std::set<double> seen;
  for (int piece = 0; piece < 3; ++piece)
  {
    reader->UpdatePiece(piece, 3, 0);
    auto* id = reader->GetOutput()->GetPointData()->GetArray("id");
    EXPECT_GT(id->GetNumberOfTuples(), 3000);
    for (vtkIdType i = 0; i < id->GetNumberOfTuples(); ++i)
    {
      EXPECT_TRUE(seen.insert(id->GetTuple1(i)).second);
    }
  }
  EXPECT_EQ(seen.size(), 20000u);
}

/// Global point ids of `data`, and that each point has the place and the values that `cloud`, an
/// overview of everything, has for that id.
std::set<vtkIdType> idsLikeIn(vtkPolyData* data, vtkPolyData* cloud)
{
  std::map<vtkIdType, vtkIdType> rowOf;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    rowOf[static_cast<vtkIdType>(cloud->GetPointData()->GetGlobalIds()->GetTuple1(i))] = i;
  }
  std::set<vtkIdType> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<vtkIdType>(data->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_TRUE(ids.insert(id).second);
    const vtkIdType row = rowOf.at(id);
    std::array<double, 3> one, other;
    data->GetPoint(i, one.data());
    cloud->GetPoint(row, other.data());
    EXPECT_EQ(one, other);
    for (const char* name : { "id", "height", "rgb" })
    {
      EXPECT_EQ(data->GetPointData()->GetArray(name)->GetComponent(i, 0),
        cloud->GetPointData()->GetArray(name)->GetComponent(row, 0));
    }
  }
  return ids;
}

TEST(Reader, PointsThatTheOverviewLacksAreReadByTheirIds)
{
  const std::string store = storeOf("ids", 20000);
  vtkNew<vtkPointFrontReader> all;
  all->SetFileName(store.c_str());
  all->Update();
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(store.c_str());
  reader->SetOverviewPoints(3000);
  reader->Update();
  const std::set<vtkIdType> overview = idsLikeIn(reader->GetOutput(), all->GetOutput());

  vtkNew<vtkIdTypeArray> named;
  std::set<vtkIdType> wanted;
  for (vtkIdType id = 19999; id >= 0; id -= 7)
  {
    named->InsertNextValue(id);
    if (overview.count(id) == 0)
    {
      wanted.insert(id);
    }
  }
  named->InsertNextValue(19999); // twice
  std::set<vtkIdType> found;
  for (int piece = 0; piece < 3; ++piece)
  {
    vtkNew<vtkPolyData> points;
    ASSERT_TRUE(reader->ReadPoints(named, piece, 3, points));
    const double share = static_cast<double>(wanted.size()) / 3.0;
    EXPECT_NEAR(static_cast<double>(points->GetNumberOfPoints()), share, 1.0);
    EXPECT_EQ(points->GetNumberOfVerts(), points->GetNumberOfPoints());
    const std::set<vtkIdType> ids = idsLikeIn(points, all->GetOutput());
    found.insert(ids.begin(), ids.end());
  }
  EXPECT_EQ(found, wanted);
}

TEST(Reader, IdsThatTheStoreHasNotAreAnError)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("no_ids", 20000).c_str());
  reader->Update();
  for (const vtkIdType id : { vtkIdType(-1), vtkIdType(20000), vtkIdType(VTK_ID_MAX) })
  {
    vtkNew<vtkIdTypeArray> named;
    named->InsertNextValue(7);
    named->InsertNextValue(id);
    vtkNew<vtkPolyData> points;
    vtkNew<ErrorObserver> errors;
    const auto tag = reader->AddObserver(vtkCommand::ErrorEvent, errors);
    EXPECT_FALSE(reader->ReadPoints(named, 0, 1, points)) << id;
    EXPECT_NE(errors->GetErrorMessage().find("no point of the id"), std::string::npos) << id;
    reader->RemoveObserver(tag);
  }
}

TEST(Reader, ReadingPointsByIdCanBeAborted)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("abort_ids", 20000).c_str());
  reader->SetOverviewPoints(1);
  reader->Update();
  vtkNew<vtkIdTypeArray> named;
  for (vtkIdType id = 0; id < 20000; ++id)
  {
    named->InsertNextValue(id);
  }
  vtkNew<vtkPolyData> points;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  const auto tag = reader->AddObserver(vtkCommand::ProgressEvent, stop);
  vtkNew<ErrorObserver> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_FALSE(reader->ReadPoints(named, 0, 1, points));
  EXPECT_EQ(points->GetNumberOfPoints(), 0);
  reader->RemoveObserver(tag);
  EXPECT_TRUE(reader->ReadPoints(named, 0, 1, points)); // the next one begins anew
  EXPECT_GT(points->GetNumberOfPoints(), 10000);
}

TEST(Reader, ReadingPointsByIdRefusesWhatIsNothing)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("no_ids", 100).c_str());
  reader->UpdateInformation();
  vtkNew<vtkIdTypeArray> named;
  named->InsertNextValue(1);
  vtkNew<vtkPolyData> points;
  vtkNew<ErrorObserver> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto refused = [&](vtkIdTypeArray* ids, int piece, int pieces, vtkPolyData* output)
  {
    errors->Clear();
    return !reader->ReadPoints(ids, piece, pieces, output) && errors->GetError();
  };
  EXPECT_TRUE(refused(nullptr, 0, 1, points));
  EXPECT_TRUE(refused(named, 0, 1, nullptr));
  EXPECT_TRUE(refused(named, 0, 0, points));
  EXPECT_TRUE(refused(named, 2, 2, points));
  EXPECT_TRUE(refused(named, -1, 2, points));
  EXPECT_TRUE(reader->ReadPoints(named, 0, 1, points));
}

TEST(Reader, TheSelectionChoosesTheArraysAndIsPartOfTheTime)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("selection", 1000).c_str());
  reader->Update();
  const auto before = reader->GetMTime();
  reader->SetPointArrayStatus("height", 0);
  EXPECT_GT(reader->GetMTime(), before);
  EXPECT_EQ(reader->GetPointArrayStatus("height"), 0);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetArray("height"), nullptr);
  EXPECT_NE(reader->GetOutput()->GetPointData()->GetArray("id"), nullptr);
}

TEST(Reader, FiltersWorkOnTheOverview)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("filters", 1000).c_str());
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(reader->GetOutputPort());
  elevation->Update();
  EXPECT_EQ(elevation->GetOutput()->GetNumberOfPoints(), 1000);
  EXPECT_NE(vtkPointFrontStore::GetStoreName(elevation->GetOutput()), ""); // the name passes
}

TEST(Reader, ErrorsHaveACodeAndAReason)
{
  vtkNew<vtkPointFrontReader> reader;
  vtkNew<ErrorObserver> errors;
  vtkNew<ErrorObserver> pipeline;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoFileNameError));

  errors->Clear();
  const std::string missing = ::testing::TempDir() + "missing.pfront";
  EXPECT_EQ(vtkPointFrontReader::CanReadFile(missing.c_str()), 0);
  reader->SetFileName(missing.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::CannotOpenFileError));
  EXPECT_NE(errors->GetErrorMessage().find("missing.pfront"), std::string::npos);

  errors->Clear();
  const std::string whole = storeOf("to_cut", 1000);
  EXPECT_EQ(vtkPointFrontReader::CanReadFile(whole.c_str()), 1);
  const std::string cut = ::testing::TempDir() + "cut.pfront";
  {
    std::ifstream in(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  }
  reader->SetFileName(cut.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileFormatError));
  EXPECT_NE(errors->GetErrorMessage().find("cut.pfront"), std::string::npos);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Reader, ProgressRisesAndAnAbortLeavesNothing)
{
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(storeOf("abort", 20000).c_str());
  double last = -1.0;
  vtkNew<vtkCallbackCommand> watch;
  watch->SetClientData(&last);
  watch->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* fraction)
    {
      EXPECT_GE(*static_cast<double*>(fraction), *static_cast<double*>(data));
      *static_cast<double*>(data) = *static_cast<double*>(fraction);
    });
  const auto tag = reader->AddObserver(vtkCommand::ProgressEvent, watch);
  reader->Update();
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 20000);

  reader->RemoveObserver(tag);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void* fraction)
    {
      if (*static_cast<double*>(fraction) > 0.3)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  reader->AddObserver(vtkCommand::ProgressEvent, stop);
  reader->Modified();
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Reader, SeveralStoresAreTimeSteps)
{
  const std::vector<std::string> stores = { storeOf("first", 1000), storeOf("second", 3000),
    storeOf("third", 2000) };
  vtkNew<vtkPointFrontReader> reader;
  for (const std::string& store : stores)
  {
    reader->AddFileName(store.c_str());
  }
  reader->UpdateInformation();
  vtkInformation* info = reader->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 2.0);
  const std::array<std::array<double, 3>, 6> asked = { { { 0, 1000, 0 }, { 2, 2000, 2 },
    { 1, 3000, 1 }, { 1.7, 3000, 1 }, { -5, 1000, 0 }, { 9, 2000, 2 } } };
  for (const auto& [time, points, step] : asked)
  {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(static_cast<double>(reader->GetOutput()->GetNumberOfPoints()), points) << time;
    EXPECT_EQ(reader->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), step);
    EXPECT_EQ(
      vtkPointFrontStore::GetStoreName(reader->GetOutput()), reader->GetStore()->GetFileName());
  }

  reader->SetFileName(stores[1].c_str());
  reader->Update();
  EXPECT_FALSE(info->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 3000);

  vtkNew<ErrorObserver> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddFileName((::testing::TempDir() + "gone.pfront").c_str());
  reader->Update();
  EXPECT_NE(errors->GetErrorMessage().find("gone.pfront"), std::string::npos);
}

TEST(Reader, AListOfStoresIsOneCloud)
{
  storeOf("tile_a", 2000);
  storeOf("tile_b", 3000);
  const std::string list = ::testing::TempDir() + "tiles.pfronts";
  std::ofstream(list) << "tile_a.pfront\ntile_b.pfront\n";
  EXPECT_EQ(vtkPointFrontReader::CanReadFile(list.c_str()), 1);
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(list.c_str());
  reader->SetOverviewPoints(1000000);
  reader->Update();
  ASSERT_NE(reader->GetStore(), nullptr);
  EXPECT_EQ(reader->GetStore()->GetNumberOfPoints(), 5000);
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPoints(), 5000);
  std::set<vtkIdType> all;
  auto* ids = vtkIdTypeArray::SafeDownCast(reader->GetOutput()->GetPointData()->GetGlobalIds());
  ASSERT_NE(ids, nullptr);
  for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
  {
    all.insert(ids->GetValue(i));
  }
  EXPECT_EQ(all.size(), 5000u);
  EXPECT_EQ(*all.rbegin(), 4999);
}

} // namespace
