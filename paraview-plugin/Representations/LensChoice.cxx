#include "LensChoice.h"

#include "pointfront/Style/StyleSheet.h"

#include "vtkImageData.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Factory.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace pointfront
{
namespace
{

/// Not 0 where a colour (of the first three components) is not black. A fourth one is opacity: what
/// is transparent is black.
std::shared_ptr<const LensMask> maskOf(vtkImageData* image)
{
  const int* const extent = image->GetExtent();
  const int components = image->GetNumberOfScalarComponents();
  const bool opaque = components == 1 || components == 3;
  auto mask = std::make_shared<LensMask>();
  mask->width = image->GetDimensions()[0];
  mask->height = image->GetDimensions()[1];
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x)
    {
      const auto value = [&](int component)
      { return image->GetScalarComponentAsDouble(x, y, extent[4], component); };
      bool covers = false;
      for (int component = 0; component < (opaque ? components : components - 1); ++component)
      {
        covers = covers || value(component) != 0.0;
      }
      covers = covers && (opaque || value(components - 1) != 0.0);
      mask->values.push_back(covers ? 1 : 0);
    }
  }
  return mask;
}

} // namespace

LensChoice::LensChoice() = default;

LensChoice::~LensChoice() = default;

void LensChoice::setMaskFile(const std::string& fileName)
{
  if (maskFile_ != fileName)
  {
    maskFile_ = fileName;
    maskRead_ = false;
  }
}

bool LensChoice::readMask(std::string& error)
{
  if (!maskRead_)
  {
    maskRead_ = true;
    mask_ = FrameLens();
    mask_.shape = LensShape::Mask;
    const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
      maskFile_.empty() ? nullptr : vtkImageReader2Factory::CreateImageReader2(maskFile_.c_str()));
    if (reader)
    {
      reader->SetFileName(maskFile_.c_str());
      reader->Update();
      vtkImageData* image = reader->GetOutput();
      const int* const size = image->GetDimensions();
      const bool picture = size[0] > 0 && size[1] > 0 && size[2] == 1 && image->GetScalarPointer();
      mask_.mask = picture ? maskOf(image) : nullptr;
    }
  }
  if (!mask_.mask)
  {
    error = maskFile_.empty() ? "a lens by a mask needs an image: name it in Lens Mask"
                              : maskFile_ + ": the lens mask is no image that can be read";
  }
  return mask_.mask != nullptr;
}

std::optional<StyleLens> LensChoice::lens(int width, int height, std::string& error)
{
  if (!shows())
  {
    return std::nullopt;
  }
  StyleLens lens;
  lens.standard = classes.sheet().standard;
  lens.classes = classes.sheet().classes;
  if (place.shape == LensPlace::MASK)
  {
    if (!readMask(error))
    {
      return std::nullopt;
    }
    lens.place = mask_;
    return lens;
  }
  if (place.shape == LensPlace::AROUND_CLASS)
  {
    lens.place.shape = LensShape::AroundClass;
    lens.aroundClass = static_cast<std::uint8_t>(std::clamp(place.aroundClass, 0, 255));
    lens.aroundRadius = place.aroundRadius;
    if (!(place.aroundRadius > 0.0) || place.aroundClass < 0 || place.aroundClass > 255)
    {
      error = "a lens around a class has a code of 0 to 255 and a radius above 0";
      return std::nullopt;
    }
    return lens;
  }
  const double size[2] = { static_cast<double>(width), static_cast<double>(height) };
  const bool circle = place.shape == LensPlace::CIRCLE;
  lens.place.shape = circle ? LensShape::Circle : LensShape::Rectangle;
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    const double half = circle ? place.radius * size[1] : 0.5 * place.size[at] * size[axis];
    lens.place.centrePx[axis] = static_cast<float>(place.centre[at] * size[axis]);
    lens.place.halfSizePx[axis] = static_cast<float>(std::max(half, 0.0));
  }
  return lens;
}

} // namespace pointfront
