// Tables of poses: what is read, and what is refused or doubted by file, row and column.
#include "files/trajectory_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "files/file_error.hpp"

namespace poise {
namespace {

class Trajectories : public testing::Test {
 protected:
  Trajectories() {
    file_ = std::filesystem::path(testing::TempDir()) /
            ("poise_trajectory_" + std::to_string(getpid()) + ".csv");
  }
  ~Trajectories() override { std::filesystem::remove(file_); }

  TrajectoryFile read(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    return read_trajectory(file_.string());
  }
  /// What is wrong, without the name of the file.
  std::string problem(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const FileError& error) {
      EXPECT_EQ(error.file(), file_.string());
      return std::string(error.what()).substr(file_.string().size());
    }
  }

  std::filesystem::path file_;
};

const std::string header = "t,x,y,z,qw,qx,qy,qz\n";

TEST_F(Trajectories, AreReadByTheNamesOfTheirColumns) {
  const TrajectoryFile read = this->read(
      "name,qx,qy,qz,qw,z,y,x,t,az,ay,ax\n"
      "a,0,0,0,1,3,2,1,0.5,9,8,7\n\n"
      "b,1,0,0,0,6,5,4,1.5,12,11,10\n");
  EXPECT_EQ(read.trajectory.times, (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(read.trajectory.positions[1], Vector<3>(4, 5, 6));
  EXPECT_EQ(read.trajectory.orientations[0].w(), 1);
  EXPECT_EQ(read.trajectory.orientations[1].x(), 1);
  EXPECT_EQ(read.trajectory.accelerations[1], Vector<3>(10, 11, 12));
  EXPECT_EQ(read.lines, (std::vector<int>{2, 4}));
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_TRUE(this->read(header + "0,0,0,0,1,0,0,0\n").trajectory.accelerations.empty());
}

TEST_F(Trajectories, SayWhatIsWrongByRowAndColumn) {
  EXPECT_EQ(problem(header + "0,0,0,0,1,0,0,0\n0,0,0,0,1,0,0,0\n"),
            ":3:1: row 2, column t: is 0, must be above that of the row before, 0");
  EXPECT_EQ(
      problem(header + "0,0,0,0,1,0,0,0\n1,0,0,0,30,0,45,0\n"),
      ":3:9: row 2, column qw: begins a quaternion of length 54.083269132, must be 1: are these "
      "angles in degrees?");
  EXPECT_EQ(problem(header + "0,0,0,0,0.5,0,0,0\n"),
            ":2:9: row 1, column qw: begins a quaternion of length 0.5, must be 1");
  EXPECT_EQ(problem(header + "0,0,zero,0,1,0,0,0\n"),
            ":2:5: row 1, column y: is \"zero\", must be a number");
  EXPECT_EQ(problem(header), ":1:1: has a header and no rows: nothing moves");
  EXPECT_EQ(problem("time,x,y,z\n"), ":1:1: header: lacks the column t, the time in seconds");
  EXPECT_EQ(problem("t,x,y,z,roll,pitch,yaw\n"),
            ":1:1: header: lacks the column qw, qx, qy, qz: orientations are quaternions, object "
            "to world, not angles");
  EXPECT_EQ(problem("t,x,y,z,qw,qx,qy,qz,ax\n"), ":1:1: header: lacks the column ay, az");
}

TEST_F(Trajectories, WarnOfGapsAndOfQuaternionsThatAreALittleOff) {
  std::string text = header;
  for (int k = 0; k < 20; ++k)
    text += std::to_string(k < 10 ? 0.01 * k : 2 + 0.01 * k) + ",0,0,0," + (k == 4 ? "1.02" : "1") +
            ",0,0,0\n";
  const TrajectoryFile read = this->read(text);
  ASSERT_EQ(read.warnings.size(), 2U);
  EXPECT_EQ(read.warnings[0].substr(file_.string().size()),
            ":6:16: row 5, column qw: begins a quaternion of length 1.02: it is made of length 1");
  EXPECT_EQ(read.warnings[1].substr(file_.string().size()),
            ":12:1: row 11, column t: comes 2.01 s after the row before, where 0.01 s is usual: "
            "what happens between is not known");
}

TEST_F(Trajectories, WarnOfMillimetres) {
  std::string text = header;
  for (int k = 0; k < 50; ++k)
    text +=
        std::to_string(0.01 * k) + "," + std::to_string(300 * std::sin(0.1 * k)) + ",0,0,1,0,0,0\n";
  const TrajectoryFile read = this->read(text);
  const std::vector<std::string> lines =
      doubts(read, motion_through(read.trajectory), file_.string());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("are positions in metres and times in seconds"), std::string::npos);
}

}  // namespace
}  // namespace poise
