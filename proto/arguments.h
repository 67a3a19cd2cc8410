#pragma once

#include "core/registry.h"
#include "proto/fields.h"

namespace wellspaced {

/// Reads a method's arguments from a request by its parameters' descriptions.
///
/// Requires: the caller has asked `fields` for everything that is not the method's, since unknown fields are
/// refused here.
/// `sized`: a sizing function says the radii, so that a radius is refused and nothing need say the density.
/// Errors, at the field: invalid_parameters for an unknown name, for a wrong type or a value out of range,
/// for a missing required parameter, and for none or more than one of its density parameters; infeasible for
/// a value that geometry rules out.
Arguments read_arguments(const Method& method, Fields& fields, bool sized = false);

/// Whether the method has a parameter of that name, "radius".
bool takes_radius(const Method& method);

/// "in [0.57735, 1)", "at least 1", ...: the range in words.
std::string range_text(const Parameter& parameter);

}  // namespace wellspaced
