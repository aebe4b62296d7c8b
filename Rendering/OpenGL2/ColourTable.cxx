#include "ColourTable.h"

#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkScalarsToColors.h>
#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Entries of a continuous function: finer than 8-bit colours tell apart, within every GL's limit.
constexpr int continuousEntries = 8192;
} // namespace

ColourTable::ColourTable() = default;
ColourTable::~ColourTable() = default;

void ColourTable::append(vtkScalarsToColors* table, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  const auto colours = vtkSmartPointer<vtkUnsignedCharArray>::Take(
    table->MapScalars(array, VTK_COLOR_MODE_MAP_SCALARS, 0));
  const unsigned char* rgba = colours->GetPointer(0);
  const int components = colours->GetNumberOfComponents();
  for (std::size_t i = 0; i < values.size(); ++i, rgba += components)
  {
    // L, LA, RGB or RGBA, as the table's maker chose.
    const bool grey = components < 3;
    const unsigned char alpha = components == 4 ? rgba[3] : (components == 2 ? rgba[1] : 255);
    texels_.insert(texels_.end(), {rgba[0], rgba[grey ? 0 : 1], rgba[grey ? 0 : 2], alpha});
  }
}

void ColourTable::sampleIntegers(vtkScalarsToColors* table, const PointColouring& colouring)
{
  const std::int64_t first = (*colouring.integers)[0];
  const std::int64_t last = (*colouring.integers)[1];
  std::vector<double> values{static_cast<double>(first) - 1.0};
  for (std::int64_t value = first; value <= last + 1; ++value)
  {
    values.push_back(static_cast<double>(value));
  }
  values.push_back(vtkMath::Nan());
  size_ = static_cast<int>(last - first + 1);
  low_ = static_cast<double>(first) - 0.5; // an integer lies in the middle of its entry
  scale_ = 1.0;
  logSign_ = 0.0;
  this->append(table, values);
}

void ColourTable::sampleRange(vtkScalarsToColors* table)
{
  const double* range = table->GetRange();
  double low = range[0];
  double high = range[1];
  const bool logarithmic =
    table->UsingLogScale() != 0 && low != 0.0 && high != 0.0 && (low > 0.0) == (high > 0.0);
  logSign_ = !logarithmic ? 0.0 : (low > 0.0 ? 1.0 : -1.0);
  if (logarithmic)
  {
    low = std::log10(logSign_ * low);
    high = std::log10(logSign_ * high);
  }
  const vtkIdType available = table->GetNumberOfAvailableColors();
  size_ = available > 0 && available <= continuousEntries ? static_cast<int>(available)
                                                          : continuousEntries;
  const double width = (high - low) / size_;
  std::vector<double> values;
  for (int entry = -1; entry <= size_; ++entry)
  {
    const double middle = low + (entry + 0.5) * width;
    values.push_back(logarithmic ? logSign_ * std::pow(10.0, middle) : middle);
  }
  values.push_back(vtkMath::Nan());
  low_ = logarithmic ? 0.0 : low;
  logLow_ = low;
  scale_ = width != 0.0 ? 1.0 / width : 0.0;
  this->append(table, values);
}

void ColourTable::update(vtkOpenGLRenderWindow* window, vtkScalarsToColors* table,
  const PointColouring& colouring, vtkMTimeType tableTime)
{
  if (texture_->GetHandle() != 0 && tableTime <= time_ && colouring == colouring_)
  {
    return;
  }
  time_ = tableTime;
  colouring_ = colouring;
  texels_.clear();
  if (colouring.integers)
  {
    this->sampleIntegers(table, colouring);
  }
  else
  {
    this->sampleRange(table);
  }
  texture_->ReleaseGraphicsResources(window);
  texture_->SetContext(window);
  texture_->SetMinificationFilter(vtkTextureObject::Nearest);
  texture_->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture_->Create2DFromRaw(
    static_cast<unsigned int>(size_ + 3), 1, 4, VTK_UNSIGNED_CHAR, texels_.data());
}

void ColourTable::activate(
  vtkShaderProgram* program, const PointColouring& colouring, double referenceZ)
{
  texture_->Activate();
  const double base =
    colouring.kind == PointColouring::Kind::Elevation ? referenceZ : colouring.base;
  program->SetUniformi("colourTable", texture_->GetTextureUnit());
  program->SetUniformi("tableSize", size_);
  program->SetUniformf("tableShift", static_cast<float>(base - low_));
  program->SetUniformf("tableScale", static_cast<float>(scale_));
  program->SetUniformf("tableLogLow", static_cast<float>(logLow_));
  program->SetUniformf("tableLogSign", static_cast<float>(logSign_));
}

void ColourTable::deactivate()
{
  if (texture_->GetTextureUnit() >= 0)
  {
    texture_->Deactivate();
  }
}

void ColourTable::release(vtkWindow* window)
{
  texture_->ReleaseGraphicsResources(window);
  time_ = 0;
}

} // namespace pointfront
