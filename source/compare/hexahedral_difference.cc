// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::compare
{
  namespace
  {
    /** Longest edge of a part of a tetrahedron by the longest of the hexahedra that it
     * touches, above which it is cut. */
    constexpr double coarsest = 2.;

    /** Parts of a part, by its corners (0 to 3) and the middles of its edges (4 to 9, as
     * mesh::edge_vertices): four at the corners, and four around a diagonal of the
     * octahedron that is left. */
    constexpr std::array<std::array<unsigned int, 4>, 8> parts{{{{0, 4, 6, 7}},
                                                                {{1, 4, 5, 8}},
                                                                {{2, 5, 6, 9}},
                                                                {{3, 7, 8, 9}},
                                                                {{4, 9, 5, 6}},
                                                                {{4, 9, 6, 7}},
                                                                {{4, 9, 7, 8}},
                                                                {{4, 9, 8, 5}}}};

    /** Integrals over one tetrahedron after the other. */
    class Integrator
    {
    public:
      Integrator(const mesh::NodalField &u_h, const ReferenceSampling &sampling)
        : u_h(u_h), evaluator(u_h), mesh(u_h.mesh()), reference(*sampling.hexahedra()),
          materials(sampling.materials())
      {
      }

      /** The square of the difference's energy norm in @p new_cell. */
      double
      energy(const unsigned int new_cell)
      {
        cell = new_cell;
        law  = &materials.linear_law(mesh.regions[cell]);
        sum  = 0.;
        Part   whole;
        double longest = 0.;
        for (unsigned int v = 0; v < 4; ++v)
          {
            whole[v].barycentric.fill(0.);
            whole[v].barycentric[v] = 1.;
            whole[v].position       = mesh.points[mesh.cells[cell][v]];
            for (unsigned int w = 0; w < v; ++w)
              longest = std::max(longest, whole[v].position.distance(whole[w].position));
          }
        integrate(whole, mesh::cell_volume(mesh, cell), longest, true);
        return sum;
      }

      double l2 = 0., h1 = 0.; ///< squares, over all cells so far
      double largest_distance = 0.;

    private:
      struct Corner
      {
        mesh::Barycentric barycentric; ///< in the cell
        Point<3>          position;
      };
      using Part = std::array<Corner, 4>;

      static Corner
      middle(const Corner &a, const Corner &b)
      {
        Corner result;
        for (unsigned int i = 0; i < 4; ++i)
          result.barycentric[i] = .5 * (a.barycentric[i] + b.barycentric[i]);
        for (unsigned int d = 0; d < 3; ++d)
          result.position[d] = .5 * (a.position[d] + b.position[d]);
        return result;
      }

      bool
      is_coarse(const Part &part, const double longest) const
      {
        Point<3> lower = part[0].position, upper = lower;
        for (unsigned int v = 1; v < 4; ++v)
          for (unsigned int d = 0; d < 3; ++d)
            {
              lower[d] = std::min(lower[d], part[v].position[d]);
              upper[d] = std::max(upper[d], part[v].position[d]);
            }
        const double enough = longest / coarsest;
        return reference.smallest_size(lower, upper, enough) < enough;
      }

      void
      integrate(const Part &part, const double volume, const double longest, const bool whole)
      {
        if (!is_coarse(part, longest))
          return add(part, volume, tet_quadrature(whole && u_h.degree() == 2 ? 5 : 2));
        std::array<Corner, 10> corners;
        std::copy(part.begin(), part.end(), corners.begin());
        for (unsigned int e = 0; e < 6; ++e)
          corners[4 + e] = middle(part[mesh::edge_vertices[e][0]], part[mesh::edge_vertices[e][1]]);
        for (const auto &numbers : parts)
          {
            Part child;
            for (unsigned int v = 0; v < 4; ++v)
              child[v] = corners[numbers[v]];
            integrate(child, volume / 8., longest / 2., false);
          }
      }

      void
      add(const Part &part, const double volume, const TetQuadrature &rule)
      {
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            mesh::Barycentric b{};
            Point<3>          x;
            for (unsigned int v = 0; v < 4; ++v)
              {
                for (unsigned int i = 0; i < 4; ++i)
                  b[i] += rule.points[q][v] * part[v].barycentric[i];
                for (unsigned int d = 0; d < 3; ++d)
                  x[d] += rule.points[q][v] * part[v].position[d];
              }
            const auto at                = reference.locate(x);
            const auto [value, gradient] = reference.evaluate(at.cell, at.unit);
            const Tensor<2, 3> G         = gradient - evaluator.gradient(cell, b);
            const double       weight    = volume * rule.weights[q];
            l2 += weight * (value - evaluator.value(cell, b)).norm_square();
            h1 += weight * G.norm_square();
            sum += weight * law->energy_density(dealii::symmetrize(G));
            largest_distance = std::max(largest_distance, at.distance);
          }
      }

      const mesh::NodalField       &u_h;
      const FieldEvaluator          evaluator;
      const mesh::TetMesh          &mesh;
      const mesh::HexahedralField  &reference;
      const mechanics::MaterialMap &materials;
      unsigned int                  cell = 0;
      const laws::LinearLaw        *law  = nullptr;
      double                        sum  = 0.;
    };
  } // namespace

  Difference
  difference_to_hexahedra(const mesh::NodalField &u_h, const ReferenceSampling &sampling)
  {
    const unsigned int n_cells = u_h.mesh().n_cells();
    const MPI_Comm     comm    = sampling.communicator();
    Integrator         integrator(u_h, sampling);
    // Cells where the hexahedra are small take longest: dealt out like cards.
    std::vector<double> sums(n_cells + std::size_t(2), 0.);
    for (unsigned int cell = this_rank(comm); cell < n_cells; cell += n_ranks(comm))
      sums[cell] = integrator.energy(cell);
    sums[n_cells]     = integrator.l2;
    sums[n_cells + 1] = integrator.h1;
    sum_over_ranks(sums, comm);

    Difference result;
    result.l2               = std::sqrt(sums[n_cells]);
    result.h1               = std::sqrt(sums[n_cells + 1]);
    result.l2_norm          = sampling.l2_norm();
    result.h1_norm          = sampling.h1_norm();
    result.energy_norm      = sampling.energy_norm();
    result.energy_noise     = sampling.energy_noise();
    result.largest_distance = max_over_ranks(integrator.largest_distance, comm);
    result.cell_energy.assign(sums.begin(), sums.begin() + n_cells);
    double energy = 0.;
    for (double &e : result.cell_energy)
      {
        energy += e;
        e = std::sqrt(std::max(e, 0.));
      }
    result.energy = std::sqrt(std::max(energy, 0.));
    return result;
  }
} // namespace tetradapt::compare
