#include "DrawBatches.h"

#include "OpenGLFunctions.h"

#include <algorithm>
#include <string>

namespace pointfront
{
namespace
{

/// Points of a batch: enough for both sides of a rasteriser's pipeline to be busy. A frame of all
/// of a million points takes 1.44 times vtkPolyDataMapper's time in batches of 2^13, 1.11 of 2^16,
/// 0.99 without any; the last one keeps 175 MiB beside all budgets, 2^16 some 20.
constexpr int batchPoints = 1 << 16;
/// Batches that are handed over and not drawn, while the next is made ready.
constexpr std::size_t mostUnderWay = 1;

} // namespace

bool glIsAProgram()
{
  const GLubyte* const text = glGetString(GL_RENDERER);
  const std::string name = text ? reinterpret_cast<const char*>(text) : "";
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

DrawBatches::~DrawBatches()
{
  for (void* const fence : underWay_)
  {
    glDeleteSync(static_cast<GLsync>(fence));
  }
}

DrawBatches::DrawBatches()
  : inTurn_(glIsAProgram())
{
}

void DrawBatches::draw(const int* firsts, const int* counts, std::size_t runs)
{
  if (inTurn_)
  {
    this->drawInTurn(firsts, counts, runs);
  }
  else
  {
    glMultiDrawArrays(GL_POINTS, firsts, counts, static_cast<GLsizei>(runs));
  }
}

void DrawBatches::drawInTurn(const int* firsts, const int* counts, std::size_t runs)
{
  for (std::size_t run = 0; run < runs; ++run)
  {
    for (int drawn = 0; drawn < counts[run];)
    {
      const int count = std::min(counts[run] - drawn, batchPoints - waiting_);
      glDrawArrays(GL_POINTS, firsts[run] + drawn, count);
      drawn += count;
      waiting_ += count;
      if (waiting_ == batchPoints)
      {
        this->flush();
        waiting_ = 0;
      }
    }
  }
}

/// Hands over what was drawn, and waits until not more than some batches are under way.
void DrawBatches::flush()
{
  underWay_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  glFlush();
  while (underWay_.size() > mostUnderWay)
  {
    const auto oldest = static_cast<GLsync>(underWay_.front());
    glClientWaitSync(oldest, GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
    glDeleteSync(oldest);
    underWay_.pop_front();
  }
}

} // namespace pointfront
