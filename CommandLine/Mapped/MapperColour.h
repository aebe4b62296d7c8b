#pragma once

#include "ColourChoice.h"

#include "vtkPointFrontMapper.h"

#include <vtkLookupTable.h>
#include <vtkNew.h>

#include <cstddef>

namespace pointfront
{

/// Sets the mapper's properties to the choice of --color-by.
inline void applyColour(const ColourChoice& colour, vtkPointFrontMapper* mapper)
{
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(colour.attribute.c_str());
  if (colour.direct)
  {
    mapper->SetColorModeToDefault();
    return;
  }
  vtkNew<vtkLookupTable> table;
  if (colour.vector)
  {
    table->SetVectorModeToRGBColors();
  }
  table->SetNumberOfTableValues(static_cast<vtkIdType>(colour.table.size()));
  for (std::size_t i = 0; i < colour.table.size(); ++i)
  {
    table->SetTableValue(static_cast<vtkIdType>(i), colour.table[i][0] / 255.0,
      colour.table[i][1] / 255.0, colour.table[i][2] / 255.0, 1.0);
  }
  table->SetTableRange(colour.range[0], colour.range[1]);
  mapper->SetColorModeToMapScalars();
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
}

} // namespace pointfront
