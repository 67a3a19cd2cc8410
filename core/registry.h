#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/control.h"
#include "core/mesh/mesh.h"
#include "core/optimize/optimize.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// A parameter of a method, as users see it: routes validate by it, /v1/operations and OpenAPI show it.
struct Parameter {
  enum class Type { integer, number, choice };

  std::string name;
  Type type = Type::number;
  std::string description;
  std::string unit;  ///< empty: a pure number
  double minimum = 0, maximum = 0;
  bool exclusive_minimum = false, exclusive_maximum = false;
  std::string fallback;  ///< what holds when it is not given, as JSON text or as words; empty: nothing
  bool required = false;
  bool density = false;  ///< exactly one of a method's density parameters must be given; with a sizing
                         ///< function, which says the radii, none or `count`
  std::string infeasible_below =
      "";  ///< why a value below the minimum can't exist; empty: it is merely not allowed
  std::string infeasible_above = "";      ///< the same for a value above the maximum
  std::vector<std::string> choices = {};  ///< the names of a choice; its fallback is one of them, in quotes
};

/// The values given for a method's parameters; integers are exact up to 2^53, a choice is its place in
/// `choices`.
using Arguments = std::map<std::string, double, std::less<>>;

/// The value of an argument, or nothing.
std::optional<double> argument(const Arguments& arguments, std::string_view name);

/// What a method will cost at most, about: for limits that are checked before the work starts. The figures
/// are measured at a million points and rounded up.
struct Cost {
  double seconds = 0;  ///< one thread, this decade's machine
  double bytes = 0;    ///< at the peak, the points themselves included
};

/// What every method has.
struct Method {
  std::string name, title, description, reference;
  std::vector<Parameter> parameters;
};

/// Where points are to be made, and how dense where.
struct Setting {
  template <class AnyDomain>
  Setting(std::shared_ptr<AnyDomain> on,
          std::shared_ptr<const Sizing> with = nullptr)  // NOLINT: a domain is one
      : domain(std::move(on)), sizing(std::move(with)) {}

  std::shared_ptr<const Domain> domain;
  std::shared_ptr<const Sizing> sizing;  ///< none: the same radius everywhere
};

struct Generator : Method {
  bool random = true;       ///< takes a seed
  bool only_torus = false;  ///< knows no other domain
  bool takes_sizing = false;
  PointSet (*run)(const Setting&, const Arguments&, Rng&, Control&) = nullptr;
  double (*expected_count)(const Setting&, const Arguments&) = nullptr;
  /// What can be refused before the work, beyond the parameters' ranges; same errors as `run`.
  void (*check)(const Setting&, const Arguments&) = nullptr;
  Cost cost_a_point;  ///< on the torus
  Cost cost_elsewhere;
};

struct Optimizer : Method {
  OptimizeResult (*run)(const PointSet&, const Arguments&, Control&) = nullptr;
  Cost (*cost_a_point)(const Arguments&) = nullptr;
  double times_elsewhere = 1;  ///< how many times as long it takes on other domains
};

struct Mesher : Method {
  Mesh (*run)(const PointSet&, const Control&) = nullptr;
  Cost cost_a_point;  ///< on the torus
  Cost cost_elsewhere;
};

/// All methods, in the order in which users see them. One row each in registry_generators.cpp,
/// registry_optimizers.cpp and registry_meshers.cpp.
std::span<const Generator> generators();
std::span<const Optimizer> optimizers();
std::span<const Mesher> meshers();

}  // namespace wellspaced
