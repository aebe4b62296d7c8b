// Vertex buffers that GL has no room for.

#include "GpuBlock.h"
#include "OpenGLFunctions.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>

using namespace pointfront;

namespace
{
/// A window whose context is current.
class GpuBlockTest : public testing::Test
{
protected:
  void SetUp() override
  {
    window_->SetOffScreenRendering(1);
    window_->SetSize(16, 16);
    window_->Render();
    window_->MakeCurrent();
    while (glGetError() != GL_NO_ERROR)
    {
    }
    values_.wanted[static_cast<std::size_t>(GpuStream::Value)] = true;
  }
  vtkNew<vtkRenderWindow> window_;
  GpuStreams values_;
};

TEST_F(GpuBlockTest, WithoutRoomIsNotWholeAndLeavesNoErrorBehind)
{
  GpuBlock block(0, std::numeric_limits<std::uint32_t>::max(), values_); // terabytes
  EXPECT_FALSE(block.whole(values_));
  EXPECT_EQ(block.positionBuffer(), 0u);
  EXPECT_EQ(block.buffer(GpuStream::Value), 0u);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  block.release();
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(GpuBlockTest, AfterOneWithoutRoomASmallerOneIsWhole)
{
  GpuBlock large(0, std::numeric_limits<std::uint32_t>::max(), values_);
  ASSERT_FALSE(large.whole(values_));
  GpuBlock small(0, 2, values_);
  EXPECT_TRUE(small.whole(values_));
  EXPECT_GT(small.bytes(), 0);
  const std::array<std::uint32_t, 3> position{ 7, 8, 9 };
  small.writePositions(1, 5, 1, position.data());
  std::array<std::uint32_t, 3> read{};
  glBindBuffer(GL_COPY_READ_BUFFER, small.positionBuffer());
  glGetBufferSubData(
    GL_COPY_READ_BUFFER, (gpuSlotPoints + 5) * GpuSlotBytes::position, sizeof read, read.data());
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  EXPECT_EQ(read, position);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  small.release();
  large.release();
}
} // namespace
