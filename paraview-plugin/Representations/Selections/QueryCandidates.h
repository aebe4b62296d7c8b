#pragma once

#include "vtkType.h"

#include <string>

class vtkPointFrontReader;
class vtkPolyData;
class vtkSelection;

namespace pointfront
{

struct StoreDescription;

/// Whether a selection is about all points of a store: by values that points have, or by all but
/// those that it names, or by more places than one.
bool asksForValues(vtkSelection* selection);

/// Whether a query asks for "id", the number of a row: rows are those of the reader's output. An
/// attribute of that name comes first.
bool asksForRows(vtkSelection* selection, const StoreDescription& store);

/// Whether all parts of a selection say by names, values or places which points of a store they
/// mean: the reader's output need not have them.
bool choosesStoredPoints(vtkSelection* selection);

/// Whether a part of a selection lists numbers of rows.
bool namesRows(vtkSelection* selection);

/// A condition (FilterExpression) that every point meets which a query of ParaView's selects, and
/// perhaps others: for a query of comparisons of attributes with numbers, joined by "&". Numbers
/// are widened by a millionth, for ParaView compares in an attribute's own type. Empty, all points,
/// for anything else: a query like "intensity == max(intensity)" depends on all of them.
std::string conditionOfQuery(const std::string& query, const StoreDescription& store);

/// The same for a whole selection: empty unless it is one query that is not inverted.
std::string conditionOfSelection(vtkSelection* selection, const StoreDescription& store);

/// Reads the points of the reader's store that meet a condition, with the arrays of the reader's
/// output; of several pieces each gets its share.
/// Errors  what reading brings, and more than `mostPoints` points; `error` says what.
bool readCandidates(vtkPointFrontReader* reader, const std::string& condition, vtkIdType mostPoints,
  int piece, int pieces, vtkPolyData* output, std::string& error);

} // namespace pointfront
