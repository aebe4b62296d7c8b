/**
 * @class vtkPVPointFrontFrame
 * @brief what all processes drew of a store in their last frame, brought to the client
 *
 * Gathered from a vtkPointFrontRepresentation with vtkSMProxy::GatherInformation(), which asks
 * every process that has one: counts add up, the spacing is the coarsest, and a frame is complete
 * when it is complete everywhere.
 */
#ifndef vtkPVPointFrontFrame_h
#define vtkPVPointFrontFrame_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVInformation.h"

#include "pointfront/Disk/ByteTraffic.h" // for counts

#include <string> // for words

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPVPointFrontFrame : public vtkPVInformation
{
public:
  static vtkPVPointFrontFrame* New();
  vtkTypeMacro(vtkPVPointFrontFrame, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void CopyFromObject(vtkObject* representation) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;

  ///@{
  /**
   * Of all processes together: points and nodes drawn; the largest projected point spacing, pixels.
   */
  vtkGetMacro(PointsDrawn, vtkIdType);
  vtkGetMacro(NodesDrawn, vtkIdType);
  vtkGetMacro(ProjectedSpacing, double);
  ///@}

  /// "412,345 of 697,721": points drawn and points of the store.
  std::string GetPointsInView() const;

  /// "34 requests, 1.2 MB; 0.3 MB from the cache": what all processes have had from servers so far,
  /// for all of their clouds, and how many nodes of this one could not be had. "none".
  std::string GetTraffic() const;

  /// The limits of all processes together: bits of vtkPointFrontRepresentation::FrameLimits, and
  /// the same in words.
  vtkGetMacro(Limits, int);
  std::string GetLimitedBy() const;
  /// "28.5 to 43.2 dB, 1 to 16 % of the pixels off (blended; docs/tradeoffs.md, 6 scenes)": how far
  /// such a picture is from the truth. "not measured": for this technique or error.
  std::string GetExpectedDifference() const;

  /// The build whose preview is drawn: "sorting, 43 %"; empty if there is none.
  const std::string& GetBuild() const { return this->Build; }

  /// MiB for points, of the process that has least.
  vtkGetMacro(HostMemoryBudget, int);

  /// No process has more to show, now or later.
  vtkGetMacro(Complete, bool);
  /// A process has more to show now.
  vtkGetMacro(Outdated, bool);

protected:
  vtkPVPointFrontFrame();
  ~vtkPVPointFrontFrame() override;

private:
  vtkPVPointFrontFrame(const vtkPVPointFrontFrame&) = delete;
  void operator=(const vtkPVPointFrontFrame&) = delete;

  vtkIdType PointsDrawn = 0;
  std::string Technique; ///< vtkPointFrontMapper::GetLastTechnique(), of processes that draw
  vtkIdType StorePoints = 0;
  vtkIdType NodesDrawn = 0;
  double ProjectedSpacing = 0.0;
  pointfront::TrafficCounts Traffic;
  vtkIdType MissingNodes = 0;
  int HostMemoryBudget = 0;
  int Limits = 0;
  bool Complete = true;
  bool Outdated = false;
  std::string Build;
};

#endif
