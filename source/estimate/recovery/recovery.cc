// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/recovery/recovery.h"

#include "difference.h"
#include "patch_solver.h"

#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/estimate/stress_difference.h"
#include "tetradapt/mesh/space_curve.h"

#include <memory>

namespace tetradapt::estimate
{
  namespace
  {
    /** Fits patch by patch, with lower degrees where the highest cannot be had. */
    template <unsigned int degree>
    class PatchFits
    {
    public:
      PatchFits(const mesh::TetMesh    &mesh,
                const RecoveryPatches  &patches,
                const StressSamples    &samples,
                const CellMaterials    &materials,
                const StressConditions *conditions)
        : mesh(mesh), patches(patches), conditions(conditions),
          cells_at_curved_walls(
            (samples_at_curved_walls * n_monomials[degree] - 1) / samples.n_a_cell() + 1),
          solver(mesh, samples, materials, conditions),
          lower(mesh, patches, samples, materials, conditions)
      {
      }

      /** @param result unit of length and coefficients; those of higher degree than
       *         the one that is found are left alone. */
      void
      fit(const unsigned int patch, std::vector<unsigned int> &cells, double *result)
      {
        if (is_on_curved_wall(patch))
          {
            patches.nearest_cells(mesh, patch, cells_at_curved_walls, cells);
            if (solver.solve(patches.vertex[patch], cells, result[0], result + 1))
              return;
          }
        for (unsigned int layers = 0; layers < 3; ++layers)
          {
            patches.cells_of(patch, layers, cells);
            if (solver.solve(patches.vertex[patch], cells, result[0], result + 1))
              return;
          }
        lower.fit(patch, cells, result);
      }

    private:
      /** Samples a coefficient; see RecoveredStress. */
      static constexpr unsigned int samples_at_curved_walls = 15;

      bool
      is_on_curved_wall(const unsigned int patch) const
      {
        return degree == 2 && conditions != nullptr
               && conditions->on_curved_wall[patches.vertex[patch]] != 0;
      }

      const mesh::TetMesh    &mesh;
      const RecoveryPatches  &patches;
      const StressConditions *conditions;
      unsigned int            cells_at_curved_walls;
      PatchSolver<degree>     solver;
      PatchFits<degree - 1>   lower;
    };

    /** A constant is always determined. */
    template <>
    class PatchFits<0>
    {
    public:
      PatchFits(const mesh::TetMesh    &mesh,
                const RecoveryPatches  &patches,
                const StressSamples    &samples,
                const CellMaterials    &materials,
                const StressConditions *conditions)
        : patches(patches), solver(mesh, samples, materials, conditions)
      {
      }

      void
      fit(const unsigned int patch, std::vector<unsigned int> &cells, double *result)
      {
        patches.cells_of(patch, 0, cells);
        solver.solve(patches.vertex[patch], cells, result[0], result + 1);
      }

    private:
      const RecoveryPatches &patches;
      PatchSolver<0>         solver;
    };

    /** The patches of a slice in an order in which neighbours come soon after each other, so
     * that the samples that they share are still in the cache. */
    std::vector<unsigned int>
    along_curve(const mesh::TetMesh   &mesh,
                const RecoveryPatches &patches,
                const compare::Slice  &slice)
    {
      std::vector<Point<3>> centers;
      for (unsigned int patch = slice.begin; patch < slice.end; ++patch)
        centers.push_back(mesh.points[patches.vertex[patch]]);
      const auto box   = mesh::bounding_box(mesh);
      auto       order = mesh::SpaceCurve(box.first, box.second).order(centers);
      for (unsigned int &patch : order)
        patch += slice.begin;
      return order;
    }

    template <unsigned int degree>
    std::vector<double>
    fit_patches(const mesh::TetMesh    &mesh,
                const RecoveryPatches  &patches,
                const CellStress       &stress,
                const StressConditions *conditions,
                MPI_Comm                communicator)
    {
      constexpr unsigned int        n_numbers = 1 + 6 * n_monomials[degree];
      const compare::TetQuadrature &rule      = compare::tet_quadrature(degree);
      const StressSamples           samples(mesh, stress, rule);
      const auto                    fits = std::make_unique<PatchFits<degree>>(
        mesh, patches, samples, stress.materials(), conditions);
      const compare::Slice      slice = compare::own_slice(patches.size(), communicator);
      std::vector<double>       result(std::size_t(patches.size()) * n_numbers, 0.);
      std::vector<unsigned int> cells;
      for (const unsigned int patch : along_curve(mesh, patches, slice))
        fits->fit(patch, cells, &result[std::size_t(patch) * n_numbers]);
      return result;
    }
  } // namespace

  RecoveredStress::RecoveredStress(const mesh::NodalField &u_h,
                                   const CellStress       &stress,
                                   const GivenLoads       *loads,
                                   MPI_Comm                communicator)
    : mesh(u_h.mesh()), linear(u_h.degree() == 1), patches(u_h.mesh())
  {
    core::together(communicator, [&] {
      std::unique_ptr<const StressConditions> conditions;
      if (loads != nullptr)
        conditions = std::make_unique<const StressConditions>(u_h, stress, patches, *loads);
      polynomials = linear ? fit_patches<1>(mesh, patches, stress, conditions.get(), communicator)
                           : fit_patches<2>(mesh, patches, stress, conditions.get(), communicator);
    });
    compare::gather_slices(polynomials,
                           patches.size(),
                           polynomials.size() / patches.size(),
                           communicator);
  }

  RecoveryEstimate
  recovery_estimate(const mesh::NodalField       &u_h,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator,
                    const scene::Scene           *scene)
  {
    const CellStress            stress(u_h, materials);
    std::unique_ptr<GivenLoads> loads;
    if (scene != nullptr)
      loads = std::make_unique<GivenLoads>(*scene, materials, u_h);
    const RecoveredStress         recovered(u_h, stress, loads.get(), communicator);
    RecoveryEstimate              result;
    const compare::TetQuadrature &rule    = compare::tet_quadrature(u_h.degree() == 1 ? 2 : 5);
    const unsigned int            n_cells = u_h.mesh().n_cells();
    if (stress.has_thermal_strain())
      result.cell_energy = stress_difference(
        u_h.mesh(),
        stress,
        [&](unsigned int cell, const mesh::Barycentric &b, const Point<3> &point, double *s) {
          recovered.at(cell, b, point, s);
        },
        rule,
        communicator);
    else
      {
        result.cell_energy.assign(n_cells, 0.);
        core::together(communicator, [&] {
          const RecoveryDifference difference(u_h.mesh(), stress, recovered, rule);
          const compare::Slice     slice = compare::own_slice(n_cells, communicator);
          for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
            result.cell_energy[cell] = difference(cell);
        });
        compare::gather_slices(result.cell_energy, n_cells, 1, communicator);
      }
    result.global = compare::root_of_squares(result.cell_energy);
    return result;
  }
} // namespace tetradapt::estimate
