// SPDX-License-Identifier: AGPL-3.0-or-later
#include "patch_solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tetradapt::estimate
{
  void
  PatchSamples::gather(const StressSamples &samples, const std::vector<unsigned int> &cells)
  {
    n_a_cell  = samples.n_a_cell();
    n_samples = cells.size() * n_a_cell;
    n_batches = (n_samples + core::n_lanes - 1) / core::n_lanes;
    rows.resize_fast(std::size_t(StressSamples::n_numbers) * n_batches * core::n_lanes);
    begin = rows.data();
    if (n_a_cell == 4)
      copy<4>(samples, cells);
    else if (n_a_cell == 1)
      copy<1>(samples, cells);
    else
      throw std::logic_error("patches are made of one or four samples a cell");
  }

  template <unsigned int n>
  void
  PatchSamples::copy(const StressSamples &samples, const std::vector<unsigned int> &cells)
  {
    const std::size_t stride = std::size_t(n_batches) * core::n_lanes;
    double           *to     = begin;
    for (const unsigned int cell : cells)
      {
        const double *from = samples[cell];
        for (unsigned int k = 0; k < StressSamples::n_numbers; ++k)
          for (unsigned int q = 0; q < n; ++q)
            to[k * stride + q] = from[k * n + q];
        to += n;
      }
  }

  namespace
  {
    // One a degree: a template would not be compiled for several processors.

    TETRADAPT_CLONES bool
    solve_system(PatchSystem<0> &system, PatchSystem<0>::Input &input)
    {
      return system.solve(input);
    }

    TETRADAPT_CLONES bool
    solve_system(PatchSystem<1> &system, PatchSystem<1>::Input &input)
    {
      return system.solve(input);
    }

    TETRADAPT_CLONES bool
    solve_system(PatchSystem<2> &system, PatchSystem<2>::Input &input)
    {
      return system.solve(input);
    }
    /** Whether two 6 x 6 matrices of StressConditions::Face are that of one plane. */
    bool
    equal_but_for_rounding(const double *a, const double *b)
    {
      constexpr double rounding = 1e-12 * StressConditions::boundary_weight;
      return std::equal(a, a + 36, b, [](const double x, const double y) {
        return std::abs(x - y) <= rounding;
      });
    }
  } // namespace

  template <unsigned int degree>
  PatchSolver<degree>::PatchSolver(const mesh::TetMesh    &mesh,
                                   const StressSamples    &samples,
                                   const CellMaterials    &materials,
                                   const StressConditions *conditions)
    : mesh(mesh), samples(samples), materials(materials), conditions(conditions)
  {
  }

  template <unsigned int degree>
  void
  PatchSolver<degree>::gather_conditions(const unsigned int               vertex,
                                         const std::vector<unsigned int> &cells)
  {
    input.has_conditions = true;
    if (elastic != &materials[cells[0]])
      {
        elastic              = &materials[cells[0]];
        const double modulus = 2. * elastic->shear_modulus;
        for (unsigned int a = 0; a < 6; ++a)
          for (unsigned int b = 0; b < 6; ++b)
            {
              input.metric[a][b]         = modulus * elastic->metric[a][b];
              input.inverse_metric[a][b] = elastic->inverse_metric[a][b] / modulus;
            }
      }
    if (!conditions->forces.empty())
      {
        forces.clear();
        for (const unsigned int cell : cells)
          for (unsigned int d = 0; d < 3; ++d)
            forces.push_back(conditions->forces[cell][d]);
        input.forces = forces.data();
      }
    input.on_boundary = conditions->on_boundary[vertex] != 0;
    faces.clear();
    if (input.on_boundary)
      gather_faces(vertex, cells);
    input.faces   = faces.data();
    input.n_faces = faces.size();
  }

  template <unsigned int degree>
  void
  PatchSolver<degree>::gather_faces(const unsigned int               vertex,
                                    const std::vector<unsigned int> &cells)
  {
    planes.clear();
    // Each point of a curved wall has a normal of its own, which costs: the nearest are enough.
    const bool only_nearest = conditions->on_curved_wall[vertex] != 0;
    for (const unsigned int cell : cells)
      if (const auto &corners = mesh.cells[cell];
          !only_nearest || std::find(corners.begin(), corners.end(), vertex) != corners.end())
        for (unsigned int f = conditions->begin[cell]; f < conditions->begin[cell + 1]; ++f)
          {
            const auto   &face   = conditions->faces[f];
            const double *matrix = &face.matrix[0][0];
            const auto    plane  = std::find_if(planes.begin(), planes.end(), [&](const double *m) {
              return equal_but_for_rounding(matrix, m);
            });
            const unsigned int number = plane - planes.begin();
            if (plane == planes.end())
              planes.push_back(matrix);
            faces.push_back(
              {planes[number], &face.points[0][0], face.right, face.n_points, number});
          }
    if (planes.size() > 1)
      std::stable_sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
        return a.plane < b.plane;
      });
  }

  template <unsigned int degree>
  bool
  PatchSolver<degree>::solve(const unsigned int               vertex,
                             const std::vector<unsigned int> &cells,
                             double                          &unit,
                             double                          *coefficients)
  {
    if (degree > 0 && cells.size() * samples.n_a_cell() < 2 * n)
      return false;
    input.samples.gather(samples, cells);
    for (unsigned int d = 0; d < 3; ++d)
      input.center[d] = mesh.points[vertex][d];
    if (degree > 0 && conditions != nullptr)
      gather_conditions(vertex, cells);
    if (!solve_system(system, input))
      return false;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int a = 0; a < 6; ++a)
        coefficients[6 * i + a] = system.solution[a][i];
    unit = system.fit.length;
    return true;
  }

  template class PatchSolver<0>;
  template class PatchSolver<1>;
  template class PatchSolver<2>;
} // namespace tetradapt::estimate
