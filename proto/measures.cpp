#include "proto/measures.h"

#include <vector>

#include "core/analyze/certificate.h"
#include "core/analyze/spacing.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

const std::vector<Measure> measure_rows = {
    {"spacing",
     "Spacing",
     "How evenly the points cover their domain: conflict and coverage radius, beta, and what follows.",
     "Ebeida et al. 2013, sections 2 and 6",
     [](const PointSet& points, const Control& control) {
       return spacing_to_json(measure_spacing(points, control));
     },
     spacing_schema,
     {8e-6, 400}},
    {"certificate",
     "Certificate",
     "Proven bounds on both radii and on beta, found with directed roundings apart from the analysis of "
     "spacing; "
     "null if the points are so nearly in lines that nothing can be proven.",
     "",
     [](const PointSet& points, const Control& control) {
       require_usable(points, control);
       return certificate_to_json(certify(points, control));
     },
     certificate_schema,
     {8e-6, 400}},
};

/// A number of the spacing object: where it comes from and what it means.
struct SpacingField {
  const char* name;
  double Spacing::*value;
  const char* description;
};

constexpr SpacingField spacing_fields[] = {
    {"beta", &Spacing::beta, "global ratio r_c / r_f"},
    {"r_f", &Spacing::r_f,
     "conflict radius: smallest distance between two points; a point's own images around the torus don't "
     "count"},
    {"r_c", &Spacing::r_c, "coverage radius: largest distance of a domain point to its nearest sample"},
    {"beta_i_max", &Spacing::beta_i_max, "largest local ratio r_c^i / r_f^i; at most beta"},
    {"beta_i_mean", &Spacing::beta_i_mean, "mean local ratio"},
    {"rho", &Spacing::rho, "r_f / d_hex, d_hex = sqrt(2 A / (sqrt(3) n))"},
    {"coverage", &Spacing::coverage, "r_c / d_hex"},
    {"packing_density", &Spacing::packing_density, "n pi r_f^2 / (4 A)"},
    {"nearest_mean", &Spacing::nearest_mean, "mean distance to the nearest sample / d_hex"},
    {"cell_area_sd", &Spacing::cell_area_sd, "standard deviation of Voronoi cell areas / their mean"},
    {"angle_min_deg", &Spacing::angle_min_deg, "smallest angle of the Delaunay triangles, degrees"},
    {"angle_max_deg", &Spacing::angle_max_deg, "largest angle of the Delaunay triangles, degrees"},
    {"edge_min", &Spacing::edge_min, "shortest Delaunay edge / r_f"},
    {"edge_max", &Spacing::edge_max, "longest Delaunay edge / r_f"},
};

struct CertificateField {
  const char* name;
  double Certificate::*value;
  const char* description;
};

constexpr CertificateField certificate_fields[] = {
    {"beta_upper", &Certificate::beta_upper, "proven: beta is not above this"},
    {"r_f_lower", &Certificate::r_f_lower, "proven: r_f is not below this"},
    {"r_c_upper", &Certificate::r_c_upper, "proven: r_c is not above this"},
};

}  // namespace

std::span<const Measure> measures() { return measure_rows; }

ordered_json spacing_to_json(const Spacing& spacing) {
  ordered_json out;
  for (const SpacingField& field : spacing_fields) out[field.name] = spacing.*field.value;
  ordered_json valence = ordered_json::object();
  for (const auto& [neighbors, samples] : spacing.valence) valence[std::to_string(neighbors)] = samples;
  out["valence"] = std::move(valence);
  return out;
}

ordered_json certificate_to_json(const std::optional<Certificate>& certificate) {
  ordered_json out;
  for (const CertificateField& field : certificate_fields)
    out[field.name] = certificate ? ordered_json((*certificate).*field.value) : ordered_json();
  return out;
}

ordered_json certificate_schema() {
  ordered_json properties, required = ordered_json::array();
  for (const CertificateField& field : certificate_fields) {
    properties[field.name] = {{"type", {"number", "null"}}, {"description", field.description}};
    required.push_back(field.name);
  }
  return {{"type", "object"}, {"required", required}, {"properties", properties}};
}

ordered_json spacing_schema() {
  ordered_json properties, required = ordered_json::array();
  for (const SpacingField& field : spacing_fields) {
    properties[field.name] = {{"type", "number"}, {"description", field.description}};
    required.push_back(field.name);
  }
  properties["valence"] = {{"type", "object"},
                           {"description", "how many samples have that many Delaunay neighbors"},
                           {"additionalProperties", {{"type", "integer"}}}};
  required.push_back("valence");
  return {{"type", "object"}, {"required", required}, {"properties", properties}};
}

}  // namespace wellspaced
