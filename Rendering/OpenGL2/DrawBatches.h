#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace pointfront
{

/// Draws runs of vertices as GL points. On a rasteriser that is a program (Mesa's llvmpipe) it
/// hands over some at a time and goes on when those before are drawn: such a driver keeps every
/// primitive that is not drawn yet in host memory, some hundred bytes for a point of 16, and does
/// not limit how many. A GPU gets all in one call.
/// Threads  that of the GL context, current in all functions.
class DrawBatches
{
public:
  void draw(const std::vector<int>& firsts, const std::vector<int>& counts);

private:
  void drawInTurn(const std::vector<int>& firsts, const std::vector<int>& counts);
  void flush();

  std::deque<void*> underWay_; ///< GLsync of batches that were handed over
};

} // namespace pointfront
