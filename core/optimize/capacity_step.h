#pragma once

#include <cstddef>
#include <vector>

#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// Area of a cell, as a part of the mean, less 1. Requires: the mesh is Delaunay around the point.
double area_deviation(const StarMesh& mesh, std::size_t i);

/// If the area of point i's cell differs from the mean by more than the part `most` of it, moves the
/// neighbors: towards i where the cell is too large, away from it where it is too small. Neighbor j goes
/// l_j 2 (A - mean) / sum of l^2 along its spoke, l_j being the length of the Voronoi edge between the two:
/// to first order the area is then the mean. Marks whatever may have come to violate a target.
///
/// Guarantees: triangles stay counter-clockwise (each neighbor's step is halved until they do, or not made);
/// a step is at most 0.2 d_hex long. Returns whether there was something to correct.
/// Reference: Ahmed et al. 2017, the capacity constraint of the push-pull algorithm.
bool capacity_step(StarMesh& mesh, std::size_t i, double most);

/// Areas of all cells of a MovingSet, in the units of their points, as parts of the mean of those inside,
/// less 1; 0 for points on the boundary, which have smaller cells by nature.
std::vector<double> area_deviations(const MovingSet& set, const Control& control);

/// capacity_step on any domain, for all points inside at once: each point goes half of what the cells of its
/// neighbors ask of it together. Marks what has moved. How many points moved.
std::size_t capacity_sweep(MovingSet& set, double most, const Control& control);

}  // namespace wellspaced
