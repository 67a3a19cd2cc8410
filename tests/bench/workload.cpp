#include "tests/bench/workload.h"

#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "core/domain/torus.h"
#include "core/generate/generate.h"
#include "core/generate/poisson_disk.h"

namespace wellspaced::bench {

const PointSet& mps(std::uint64_t count, std::uint64_t seed) {
  static std::map<std::pair<std::uint64_t, std::uint64_t>, PointSet> made;
  auto found = made.find({count, seed});
  if (found == made.end()) {
    Rng rng(seed);
    Control control(2);
    found = made.emplace(std::pair(count, seed), poisson_disk(std::make_shared<Torus>(),
                                                              {poisson_disk_radius(1, count)}, rng, control))
                .first;
  }
  return found->second;
}

double peak_mib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      double kib = 0;
      status >> kib;
      return kib / 1024;
    }
  return 0;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace wellspaced::bench
