#include "proto/sizing.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/domain/grid_sizing.h"
#include "core/domain/surface_mesh.h"
#include "core/domain/vertex_sizing.h"
#include "core/error.h"
#include "proto/fields.h"
#include "proto/formats/base64.h"
#include "proto/formats/gray_image.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

double radius_field(Fields& fields, const char* name) {
  fields.require(name, "a radius, in lengths of the domain");
  return *fields.number(name);
}

std::shared_ptr<const Sizing> constant(Fields& fields) {
  const double radius = radius_field(fields, "radius");
  fields.refuse_unknown();
  return std::make_shared<ConstantSizing>(radius);
}

constexpr const char* axes[] = {"x", "y", "z"};

int axis_field(Fields& fields, const Domain& domain) {
  const std::string name = fields.text("axis").value_or("x");
  for (int axis = 0; axis < domain.dimension(); ++axis)
    if (name == axes[axis]) return axis;
  throw Error(ErrorCode::invalid_parameters, domain.dimension() == 3 ? "must be x, y or z" : "must be x or y",
              fields.pointer_to("axis"));
}

std::shared_ptr<const Sizing> linear(Fields& fields, const Domain& domain) {
  const LinearSizingOptions options{axis_field(fields, domain), radius_field(fields, "from"),
                                    radius_field(fields, "to")};
  fields.refuse_unknown();
  return std::make_shared<LinearSizing>(domain, options);
}

constexpr std::size_t most_values = 1u << 20, most_pixels = 1u << 22;

/// Appends the numbers of an array. What they must be is the sizing function's to say.
void read_numbers(const json& array, const std::string& where, std::vector<double>& numbers) {
  if (!array.is_array())
    throw Error(ErrorCode::invalid_parameters, "must be an array of radii, not " + describe(array), where);
  for (std::size_t k = 0; k < array.size(); ++k) {
    if (!array[k].is_number())
      throw Error(ErrorCode::invalid_parameters, "must be a radius, not " + describe(array[k]),
                  where + "/" + std::to_string(k));
    numbers.push_back(array[k].get<double>());
  }
}

RadiusGrid read_rows(const json& rows, const std::string& where) {
  if (rows.is_array() && rows.empty())
    throw Error(ErrorCode::invalid_parameters, "there are no rows; give an array of one at least", where);
  if (!rows.is_array())
    throw Error(ErrorCode::invalid_parameters,
                "must be an array of rows, the lowest y first, not " + describe(rows), where);
  RadiusGrid grid;
  for (const json& row : rows) {
    const std::string at = where + "/" + std::to_string(grid.rows++);
    read_numbers(row, at, grid.radii);
    if (grid.rows == 1) grid.columns = grid.radii.size();
    if (grid.radii.empty() || grid.radii.size() != grid.rows * grid.columns)
      throw Error(ErrorCode::invalid_parameters, "must have as many radii as the first row, and one at least",
                  at);
    if (grid.radii.size() > most_values)
      throw Error(ErrorCode::too_large,
                  "there are more than " + std::to_string(most_values) + " radii; give a coarser grid",
                  where);
  }
  return grid;
}

std::shared_ptr<const Sizing> grid(Fields& fields, const Domain& domain) {
  RadiusGrid radii = read_rows(fields.require("radii", "rows of radii"), fields.pointer_to("radii"));
  fields.refuse_unknown();
  return std::make_shared<GridSizing>(domain, std::move(radii));
}

std::shared_ptr<const Sizing> vertices(Fields& fields, const Domain& domain) {
  std::vector<double> radii;
  read_numbers(fields.require("radii", "a radius for each vertex of the mesh"), fields.pointer_to("radii"),
               radii);
  fields.refuse_unknown();
  if (const auto* mesh = dynamic_cast<const SurfaceMesh*>(&domain))
    return std::make_shared<VertexSizing>(*mesh, std::move(radii));
  throw Error(ErrorCode::invalid_parameters,
              "vertices are for domains of the type mesh; a " + std::string(domain.type()) +
                  " takes constant, linear, grid and image",
              fields.pointer_to("type"));
}

/// A grid of radii that came as an image.
class ImageSizing final : public GridSizing {
 public:
  struct Source {
    std::string png;  ///< in base64
    double black = 0, white = 0;
  };

  ImageSizing(const Domain& domain, RadiusGrid radii, Source source)
      : GridSizing(domain, std::move(radii)), source_(std::move(source)) {}
  std::string_view type() const override { return "image"; }
  const Source& source() const { return source_; }

 private:
  Source source_;
};

/// Images have their top row first, grids their lowest one.
RadiusGrid radii_of_image(const GrayImage& image, double black, double white) {
  RadiusGrid grid{image.columns, image.rows, {}};
  grid.radii.reserve(image.brightness.size());
  for (std::size_t row = image.rows; row-- > 0;)
    for (std::size_t column = 0; column < image.columns; ++column)
      grid.radii.push_back(black + (white - black) * image.brightness[row * image.columns + column]);
  return grid;
}

std::shared_ptr<const Sizing> image(Fields& fields, const Domain& domain) {
  fields.require("png", "a PNG file in base64");
  if (fields.text("png") == "")
    throw Error(ErrorCode::invalid_parameters, "it is empty; give a PNG file in base64",
                fields.pointer_to("png"));
  ImageSizing::Source source{*fields.text("png"), radius_field(fields, "black"),
                             radius_field(fields, "white")};
  fields.refuse_unknown();
  for (const auto& [name, radius] : {std::pair{"black", source.black}, std::pair{"white", source.white}})
    Sizing::require_radius(radius, fields.pointer_to(name));
  try {
    const GrayImage gray = read_png_gray(decode_base64(source.png), most_pixels);
    RadiusGrid radii = radii_of_image(gray, source.black, source.white);
    return std::make_shared<ImageSizing>(domain, std::move(radii), std::move(source));
  } catch (const Error& error) {
    if (!error.where().empty() || error.code() == ErrorCode::invalid_parameters) throw;
    throw Error(ErrorCode::invalid_parameters, error.what(), fields.pointer_to("png"));
  }
}

}  // namespace

std::shared_ptr<const Sizing> read_sizing(const json& value, const Domain& domain, const std::string& where) {
  Fields fields(value, where);
  fields.require("type", "constant, linear, grid, image or vertices");
  const std::string type = *fields.text("type");
  try {
    if (type == "constant") return constant(fields);
    if (type == "linear") return linear(fields, domain);
    if (type == "grid") return grid(fields, domain);
    if (type == "image") return image(fields, domain);
    if (type == "vertices") return vertices(fields, domain);
  } catch (const Error& error) {
    if (error.where().starts_with(where)) throw;
    throw error.within(where);
  }
  throw Error(ErrorCode::invalid_parameters,
              "unknown sizing; there are: constant, linear, grid, image, vertices",
              fields.pointer_to("type"));
}

ordered_json sizing_to_json(const Sizing* sizing) {
  if (sizing == nullptr) return nullptr;
  if (const auto* linear = dynamic_cast<const LinearSizing*>(sizing)) {
    const LinearSizingOptions& o = linear->options();
    return {{"type", "linear"}, {"axis", axes[o.axis]}, {"from", o.from}, {"to", o.to}};
  }
  if (const auto* image = dynamic_cast<const ImageSizing*>(sizing)) {
    const ImageSizing::Source& s = image->source();
    return {{"type", "image"}, {"png", s.png}, {"black", s.black}, {"white", s.white}};
  }
  if (const auto* grid = dynamic_cast<const GridSizing*>(sizing)) {
    ordered_json rows = ordered_json::array();
    const std::vector<double>& radii = grid->grid().radii;
    for (auto row = radii.begin(); row != radii.end();
         row += static_cast<std::ptrdiff_t>(grid->grid().columns))
      rows.push_back(std::vector<double>(row, row + static_cast<std::ptrdiff_t>(grid->grid().columns)));
    return {{"type", "grid"}, {"radii", std::move(rows)}};
  }
  if (const auto* vertices = dynamic_cast<const VertexSizing*>(sizing))
    return {{"type", "vertices"}, {"radii", vertices->radii()}};
  return {{"type", sizing->type()}, {"radius", sizing->least()}};
}

ordered_json sizing_in_result(const Sizing& sizing) {
  ordered_json json = {{"type", sizing.type()}};
  const auto* grid = dynamic_cast<const GridSizing*>(&sizing);
  if (grid != nullptr) json.update({{"columns", grid->grid().columns}, {"rows", grid->grid().rows}});
  if (grid == nullptr && sizing.type() != "vertices") json = sizing_to_json(&sizing);
  json.update({{"least", sizing.least()}, {"most", sizing.most()}, {"lipschitz", sizing.lipschitz()}});
  return json;
}

ordered_json sizing_schema() {
  const ordered_json radius = {{"type", "number"}, {"exclusiveMinimum", 0}};
  const ordered_json radii = {{"type", "array"}, {"items", radius}, {"minItems", 1}};
  const auto variant = [](const char* type, ordered_json properties, ordered_json required) {
    properties["type"] = {{"type", "string"}, {"enum", {type}}};
    required.push_back("type");
    return ordered_json{{"type", "object"},
                        {"properties", std::move(properties)},
                        {"required", std::move(required)},
                        {"additionalProperties", false}};
  };
  ordered_json axis = {{"type", "string"}, {"enum", {"x", "y", "z"}}, {"default", "x"}};
  ordered_json png = {{"type", "string"}, {"contentEncoding", "base64"}, {"contentMediaType", "image/png"}};
  return {{"description",
           "r(x), the radius that is wanted, or that the points were made for, where they are denser in some "
           "places: "
           "lengths are in units of it. linear: from one side of the domain's box to the other along an "
           "axis, z on "
           "spheres and meshes only. grid: rows of radii over the box, the lowest y first (on a sphere "
           "longitude and "
           "latitude, the south first), bilinear between the middles of its cells. image: a PNG over the "
           "same, its "
           "top row at the highest y; from the radius `black` to the radius `white` by how bright it is. "
           "vertices: a "
           "radius at each vertex of a mesh, linear on its faces."},
          {"oneOf",
           {variant("constant", {{"radius", radius}}, {"radius"}),
            variant("linear", {{"axis", axis}, {"from", radius}, {"to", radius}}, {"from", "to"}),
            variant("grid", {{"radii", {{"type", "array"}, {"items", radii}, {"minItems", 1}}}}, {"radii"}),
            variant("image", {{"png", png}, {"black", radius}, {"white", radius}}, {"png", "black", "white"}),
            variant("vertices", {{"radii", radii}}, {"radii"})}}};
}

}  // namespace wellspaced
