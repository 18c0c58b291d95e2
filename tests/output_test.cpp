// What the commands write: whole or not at all, never over what they read, and what stands in it.
#include <sys/stat.h>

#include <map>

#include "command_line.hpp"

namespace poise {
namespace {

class Written : public CommandLine {
 protected:
  Written() {
    write("cube.obj",
          "v -30 -30 -30\nv 30 -30 -30\nv -30 30 -30\nv 30 30 -30\nv -30 -30 30\nv 30 -30 30\n"
          "v -30 30 30\nv 30 30 30\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n"
          "f 2 4 8 6\n");
    write("cube.yaml", in_a_jaw("cube.obj"));
    write("plane.yaml", plane);
    fs::create_directory(folder() / "folder");
    fs::create_hard_link(folder() / "plane.yaml", folder() / "name.svg");
    fs::create_hard_link(folder() / "cube.yaml", folder() / "cube.svg");
    fs::create_symlink("plane.yaml", folder() / "link.svg");
    fs::create_symlink("none", folder() / "nothing.svg");
    write("in.jsonl", line + line);
  }

  static std::string in_a_jaw(const std::string& mesh) {
    return "poise: 1\ndimension: 3\nup: [0, 0, 1]\nlength_unit: mm\n"
           "object: {density: 1000, shape: {mesh: " +
           mesh +
           "}}\n"
           "gripper: {type: parallel_jaw, position: [0, 0, 0], opening: 100, pad: {width: 20, "
           "height: 20}, friction: 0.5}\n";
  }

  static inline const std::string plane =
      "poise: 1\ndimension: 2\nangle_deg: 0\nobject: {weight: 10, com: [0, 0]}\ncontacts:\n"
      "  - {position: [-1, 0], normal: [1, 0], friction: 0.8}\n"
      "  - {position: [1, 0], normal: [-1, 0], friction: 0.8}\n";
  static inline const std::string line =
      R"({"poise": 1, "dimension": 2, "object": {"weight": 10, "com": [0, 0]}, "contacts": )"
      R"([{"position": [-1, 0], "normal": [1, 0], "friction": 0.8}, )"
      R"({"position": [1, 0], "normal": [-1, 0], "friction": 0.8}]})"
      "\n";

  /// All files of the folder, with what is in them, but for what the shell writes.
  std::map<std::string, std::string> all() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder())) {
      const std::string name = entry.path().lexically_relative(folder());
      if (name != "out.txt" && name != "err.txt")
        files[name] = entry.is_regular_file() ? contents(entry.path()) : "";
    }
    return files;
  }
};

TEST_F(Written, NothingOverAnInputOrAFolder) {
  const std::string read = " is read by this command, must be another file";
  const auto before = all();
  for (const auto& [arguments, words] : {
           std::pair<std::string, std::string>("curve plane.yaml --plot plane.yaml",
                                               "plane.yaml:" + read),
           {"curve plane.yaml --plot ./folder/../plane.yaml", "plane.yaml:" + read},
           {"curve plane.yaml --plot name.svg", "name.svg:" + read},
           {"curve plane.yaml --plot link.svg", "link.svg:" + read},
           {"curve - --plot plane.yaml < plane.yaml", "plane.yaml:" + read},
           {"curve plane.yaml --plot folder", "folder: is a folder, must be a file"},
           {"curve plane.yaml --plot nothing.svg", "nothing.svg: is a link to what is not there"},
           {"curve plane.yaml --plot none/x.svg",
            "none/x.svg: cannot be written: No such file or directory"},
           {"draw plane.yaml -o name.svg", "name.svg:" + read},
           {"draw cube.yaml -o cube.svg", "cube.svg:" + read},
           {"view plane.yaml -o plane.yaml", "plane.yaml:" + read},
           {"view plane.yaml -o folder", "folder: is a folder, must be a file"},
           {"contacts cube.yaml -o cube.yaml", "cube.yaml:" + read},
           {"contacts cube.yaml -o cube.obj", "cube.obj:" + read},
           {"contacts cube.yaml -o folder", "folder: is a folder, must be a file"},
           {"batch in.jsonl -o in.jsonl", "in.jsonl:" + read},
           {"batch - -o in.jsonl < in.jsonl", "in.jsonl:" + read},
           {"batch . -o plane.yaml", "plane.yaml:" + read},
           {"batch in.jsonl -o folder", "folder: is a folder, must be a file"},
           {"batch in.jsonl -o nothing.svg", "nothing.svg: is a link to what is not there"},
       }) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << arguments << ": " << run.err;
    EXPECT_EQ(all(), before) << arguments;
  }
}

TEST_F(Written, PartsOfABatchAreNotItsInputs) {
  write("a.part", line);
  write("b.run", line);
  const auto before = all();
  for (const std::string arguments :
       {"batch a.part -o a", "batch a.part -o a --resume", "batch b.run -o b"}) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find("is read by this command"), std::string::npos) << run.err;
    EXPECT_EQ(all(), before) << arguments;
  }
}

TEST_F(Written, LinksDevicesAndPipesStayWhatTheyAre) {
  write("old.json", "old");
  fs::create_symlink("old.json", folder() / "link.json");
  EXPECT_EQ(poise("contacts plane.yaml -o link.json").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder() / "link.json"));
  EXPECT_TRUE(Json::accept(contents(folder() / "old.json")));
  EXPECT_EQ(poise("batch in.jsonl -o link.json").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder() / "link.json"));
  EXPECT_EQ(contents(folder() / "old.json").find("{\"record\":0"), 0U);

  for (const std::string command :
       {"curve plane.yaml --plot ", "contacts cube.yaml -o ", "batch in.jsonl -o "}) {
    EXPECT_EQ(poise(command + "/dev/null").status, 0) << command;
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_FALSE(fs::exists("/dev/null.part"));
  }
  const Outcome run = poise("batch in.jsonl -o /dev/stdout | cat");
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2) << run.out;
  EXPECT_NE(poise("batch in.jsonl -o /dev/null --resume").err.find("is not a file"),
            std::string::npos);

  ASSERT_EQ(mkfifo((folder() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(poise("contacts plane.yaml -o pipe").status, 2);  // nobody reads it
  // Its end to read is open before anybody writes, whenever cat comes to run.
  const Outcome through =
      shell("exec 3<> pipe 4< pipe; cat <&4 3>&- > through.json & '" POISE_PROGRAM
            "' contacts plane.yaml -o pipe; exec 3>&- 4<&-; wait");
  EXPECT_EQ(through.status, 0) << through.err;
  EXPECT_TRUE(Json::accept(contents(folder() / "through.json")));
  EXPECT_TRUE(fs::is_fifo(folder() / "pipe"));
}

TEST_F(Written, AFileKeepsItsPermissions) {
  write("secret.json", "old");
  fs::permissions(folder() / "secret.json", fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(poise("contacts plane.yaml -o secret.json").status, 0);
  EXPECT_EQ(fs::status(folder() / "secret.json").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Written, WhatHasNoEndIsNotRead) {
  ASSERT_EQ(mkfifo((folder() / "pipe.yaml").c_str(), 0600), 0);
  for (const std::string arguments :
       {"check pipe.yaml", "verify plane.yaml pipe.yaml", "batch pipe.yaml"}) {
    const Outcome run = poise(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(run.err, "poise: pipe.yaml: is not a regular file\n");
  }
  // In a folder it is one bad record; what is hidden is none.
  fs::rename(folder() / "pipe.yaml", folder() / "folder/a.yaml");
  write("folder/.b.yaml", "swap");
  write("folder/c.YAML", plane);
  write("folder/d.yaml~", "old");
  const Outcome run = poise("batch folder");
  EXPECT_EQ(run.status, 1);
  ASSERT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2) << run.out;
  const Json first = Json::parse(run.out.substr(0, run.out.find('\n')));
  EXPECT_EQ(first["file"], "a.yaml");
  EXPECT_EQ(first["error"]["problem"], "is not a regular file");
  EXPECT_NE(run.out.find("\"file\":\"c.YAML\""), std::string::npos) << run.out;
}

TEST_F(Written, EndingsMayBeInCapitalLetters) {
  EXPECT_EQ(poise("draw plane.yaml -o A.SVG").status, 0);
  EXPECT_NE(contents(folder() / "A.SVG").find("<svg"), std::string::npos);
  EXPECT_EQ(poise("draw cube.yaml -o B.PNG").status, 0);
  EXPECT_EQ(contents(folder() / "B.PNG").substr(1, 3), "PNG");
}

TEST_F(Written, PicturesAreXmlWhateverNamesThereAre) {
  write("names.yaml", "name: \"]]> <!-- \\uFFFE \\u202E &\"\n" + plane);
  for (const std::string command : {"draw names.yaml -o a.svg", "curve names.yaml --plot a.svg"}) {
    EXPECT_EQ(poise(command).status, 0);
    const std::string svg = contents(folder() / "a.svg");
    EXPECT_NE(svg.find("]]&gt; &lt;!--"), std::string::npos) << command;
    EXPECT_EQ(svg.find("\xEF\xBF\xBE"), std::string::npos);
    EXPECT_EQ(svg.find("\xE2\x80\xAE"), std::string::npos);
    const Outcome parsed =
        shell("/usr/bin/python3 -c 'import xml.dom.minidom; xml.dom.minidom.parse(\"a.svg\")'");
    EXPECT_EQ(parsed.status, 0) << parsed.err;
  }
}

TEST_F(Written, WhatIsNotSeenIsShown) {
  write("unseen.yaml", "name: \"a\\u202Eb\\u2066c\\u200Bd\\u2028e\\u00ADf\"\n" + plane);
  const Outcome text = poise("hold unseen.yaml");
  EXPECT_EQ(text.out.find("a?b?c?d?e?f\n"), 0U) << text.out;
  const std::string document = poise("check unseen.yaml --json").out;
  EXPECT_NE(document.find(R"(a\u202eb\u2066c\u200bd\u2028e\u00adf)"), std::string::npos)
      << document;
  EXPECT_EQ(Json::parse(document)["name"], "a\u202Eb\u2066c\u200Bd\u2028e\u00ADf");
  write("unseen.jsonl", "{\"name\": \"a\u202Eb\", " + line.substr(1));
  EXPECT_NE(poise("batch unseen.jsonl").out.find(R"(a\u202eb)"), std::string::npos);
  EXPECT_EQ(poise("check a\u202Eb.yaml").err, "poise: a?b.yaml: does not exist\n");
}

}  // namespace
}  // namespace poise
