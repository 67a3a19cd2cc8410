#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path root = WELLSPACED_SOURCE_DIR;

/// Which folder may include what starts with this text.
struct Rule {
  std::string include;
  std::vector<std::string> allowed;
};

const std::vector<Rule> rules = {
    {"\"proto/", {"proto/", "server/"}},
    {"\"server/", {"server/"}},
    {"<CGAL/",
     {"core/voronoi/delaunay.cpp", "core/domain/mesh_crossings.cpp", "core/domain/polygon_triangles.cpp",
      "core/domain/cgal_triangulation.h", "core/mesh/planar_delaunay.cpp", "core/mesh/planar_voronoi.cpp",
      "core/mesh/triangulate_rings.cpp"}},
    {"<httplib", {"server/http/"}},
    {"<nlohmann/", {"proto/", "server/"}},
    {"<spdlog/", {"server/"}},
    {"<sqlite3", {"server/jobs/"}},
    {"<CLI/", {"server/config.cpp"}},
};

std::vector<std::string> sources() {
  std::vector<std::string> found;
  for (const char* layer : {"core", "proto", "server"})
    for (const auto& entry : fs::recursive_directory_iterator(root / layer))
      if (entry.is_regular_file()) found.push_back(fs::relative(entry.path(), root).string());
  return found;
}

TEST(Layers, IncludeOnlyWhatIsBelowThem) {
  const std::vector<std::string> files = sources();
  ASSERT_GT(files.size(), 50u);
  for (const std::string& file : files) {
    std::ifstream stream(root / file);
    for (std::string line; std::getline(stream, line);)
      for (const Rule& rule : rules) {
        if (!line.starts_with("#include " + rule.include)) continue;
        bool allowed = false;
        for (const std::string& prefix : rule.allowed) allowed = allowed || file.starts_with(prefix);
        EXPECT_TRUE(allowed) << file << ": " << line;
      }
  }
}

TEST(Layers, KeepTheCoreQuiet) {
  for (const std::string& file : sources()) {
    if (!file.starts_with("core/")) continue;
    std::ifstream stream(root / file);
    for (std::string line; std::getline(stream, line);)
      for (const char* word : {"<iostream>", "std::cout", "std::cerr", "printf(", "std::random_device",
                               "std::mt19937", "using namespace std"})
        EXPECT_EQ(line.find(word), std::string::npos) << file << ": " << line;
  }
}

/// Two functions of one name in two such files would be one to the linker, whichever it takes.
TEST(Layers, KeepWhatIsCompiledOnceAWidthInItsFile) {
  int files = 0;
  for (const std::string& file : sources()) {
    std::ifstream stream(root / file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!file.ends_with(".cpp") || text.find("<hwy/foreach_target.h>") == std::string::npos) continue;
    ++files;
    EXPECT_NE(text.find("namespace wellspaced::HWY_NAMESPACE {\nnamespace {\n"), std::string::npos) << file;
  }
  EXPECT_GT(files, 4);
}

}  // namespace
