#include "bad_files.hpp"

#include <gtest/gtest.h>

#include <set>

#include "files/grasp_file.hpp"

namespace poise {
namespace {

TEST(BadFiles, AreRefusedInTheseWords) {
  for (const BadFile& bad : bad_files) {
    try {
      grasp_from_yaml(bad.text, "f.yaml");
      ADD_FAILURE() << bad.name << ": was read";
    } catch (const FileError& error) {
#ifdef __wasm__
      if (error.problem().ends_with("where there are no files: use poise view")) continue;
#endif
      EXPECT_EQ(error.what(), "f.yaml:" + bad.message) << bad.name;
      EXPECT_EQ(error.what(), located(error.file(), {error.line(), error.column()}, error.path(),
                                      error.problem()));
    }
  }
}

TEST(BadFiles, HaveEachTheirName) {
  std::set<std::string> names;
  for (const BadFile& bad : bad_files) EXPECT_TRUE(names.insert(bad.name).second) << bad.name;
  EXPECT_GE(names.size(), 50U);
}

}  // namespace
}  // namespace poise
