#pragma once

#include <hwy/targets.h>

namespace wellspaced::testing {

/// Runs `work` once for every kind of vector unit that this CPU has and the program was compiled for.
template <class Work>
void on_every_vector_width(const Work& work) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    work(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace wellspaced::testing
