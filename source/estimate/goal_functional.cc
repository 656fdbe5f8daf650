// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/goal_functional.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/adaptive_quadrature.h"
#include "tetradapt/estimate/goal_points.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/finalize.h"

#include "goal_assembly.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::estimate
{
  namespace
  {
    using dealii::SymmetricTensor;
    using scene::GoalType;

    constexpr double accuracy = 1e-6; ///< of the integral of a weight

    constexpr std::array<std::array<unsigned int, 2>, 6> stress_indices{
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{1, 2}}, {{2, 0}}}};

    /** S with S : s = the sum of weights times the components xx, yy, zz, xy, yz, zx. */
    SymmetricTensor<2, 3>
    stress_weight(const double *weights)
    {
      SymmetricTensor<2, 3> S;
      for (unsigned int i = 0; i < 6; ++i)
        S[stress_indices[i][0]][stress_indices[i][1]] = (i < 3 ? 1. : 0.5) * weights[i];
      return S;
    }

    /** Puts one goal on one mesh. */
    class GoalOnMesh
    {
    public:
      GoalOnMesh(const scene::GoalParameters &goal,
                 const mesh::NodalField      &field,
                 Comparison                  &comparison,
                 const HierarchicalSurplus   *surplus)
        : goal(goal), what("Goals/" + goal.name), field(field), mesh(field.mesh()),
          comparison(comparison), communicator(comparison.mpi_communicator()),
          assembly(field, surplus, comparison.material_map())
      {
        const auto box = mesh::bounding_box(mesh);
        diagonal       = box.first.distance(box.second);
      }

      GoalFunctional
      run()
      {
        switch (goal.type)
          {
          case GoalType::point_displacement:
            add_point();
            return assembly.finish(1., communicator);
          case GoalType::point_stress:
            return add_mean_stress(kernel(), "the ball around Point does not meet the body");
          case GoalType::mean_stress:
            return add_mean_stress(weight(),
                                   "the integral of Weight over the body is not positive");
          case GoalType::mean_displacement:
            return add_mean_displacement();
          case GoalType::functional:
            break;
          }
        add_functional();
        return assembly.finish(1., communicator);
      }

    private:
      void
      add_point()
      {
        const compare::Location found = locate_goal(goal, comparison.locator());
        Tensor<1, 3>            unit;
        unit[goal.component_index()] = 1.;
        if (compare::this_rank(communicator) == 0)
          assembly.add_force(found.cell, found.barycentric, unit);
      }

      Densities
      kernel() const
      {
        Densities densities;
        densities.largest_part = 0.5 * goal.radius;
        densities.radius       = goal.radius;
        densities.center       = goal.point;
        densities.evaluate     = [this](const Point<3> &x, double *value) {
          const double s = 1. - x.distance_square(goal.point) / (goal.radius * goal.radius);
          value[0]       = s > 0. ? s * s : 0.;
        };
        return densities;
      }

      Densities
      weight() const
      {
        const core::Expression expression(goal.weight, what + "/Weight");
        Densities              densities;
        densities.constant     = expression.is_constant();
        densities.largest_part = diagonal / 16.;
        densities.evaluate
          = [expression](const Point<3> &x, double *value) { value[0] = expression(x); };
        if (densities.constant)
          {
            const double constant = expression(Point<3>());
            densities.evaluate = [constant](const Point<3> &, double *value) { *value = constant; };
          }
        return densities;
      }

      /** Several expressions as densities from @p first on; none if the first text is
       * empty. */
      template <std::size_t n>
      std::vector<core::Expression>
      expressions(const std::array<std::string, n> &texts, const std::string &name) const
      {
        std::vector<core::Expression> result;
        if (!texts[0].empty())
          for (const std::string &text : texts)
            result.emplace_back(text, what + "/" + name);
        return result;
      }

      Densities
      densities_of(const std::vector<core::Expression> &expressions) const
      {
        Densities densities;
        densities.n            = expressions.size();
        densities.constant     = std::all_of(expressions.begin(),
                                         expressions.end(),
                                         [](const core::Expression &e) { return e.is_constant(); });
        densities.largest_part = diagonal / 16.;
        densities.evaluate     = [expressions](const Point<3> &x, double *values) {
          for (const core::Expression &expression : expressions)
            *values++ = expression(x);
        };
        return densities;
      }

      /** Whether a cell may touch the ball of a point stress. */
      bool
      is_near(unsigned int cell) const
      {
        if (goal.type != GoalType::point_stress)
          return true;
        Point<3> centre;
        for (const unsigned int v : mesh.cells[cell])
          centre += 0.25 * Tensor<1, 3>(mesh.points[v]);
        double radius = 0.;
        for (const unsigned int v : mesh.cells[cell])
          radius = std::max(radius, centre.distance(mesh.points[v]));
        return centre.distance(goal.point) <= radius + goal.radius;
      }

      void
      visit_cells(const Densities &densities, const PointVisitor &visitor) const
      {
        const auto                all = compare::own_slice(mesh.n_cells(), communicator);
        std::vector<unsigned int> cells;
        for (unsigned int cell = all.begin; cell < all.end; ++cell)
          if (is_near(cell))
            cells.push_back(cell);
        const auto part = [&](unsigned int k) {
          IntegrationPart<4> result;
          result.cell = cells[k];
          for (unsigned int i = 0; i < 4; ++i)
            result.corners[i][i] = 1.;
          result.measure = mesh::cell_volume(mesh, cells[k]);
          return result;
        };
        visit_parts<4>(mesh, densities, cells.size(), part, accuracy, communicator, visitor);
      }

      void
      visit_faces(const Densities &densities, const PointVisitor &visitor) const
      {
        const auto                all   = compare::own_slice(mesh.faces.size(), communicator);
        const auto                slots = number_faces(mesh).boundary_slots;
        std::vector<unsigned int> faces;
        for (unsigned int f = all.begin; f < all.end; ++f)
          if (is_selected(f))
            faces.push_back(f);
        const auto part = [&](unsigned int k) {
          const unsigned int slot = slots[faces[k]];
          IntegrationPart<3> result;
          result.cell = slot / 4;
          for (unsigned int i = 0; i < 3; ++i)
            result.corners[i][mesh::face_vertices[slot % 4][i]] = 1.;
          result.measure = mesh::face_area_vector(mesh, mesh.faces[faces[k]]).norm();
          return result;
        };
        visit_parts<3>(mesh, densities, faces.size(), part, accuracy, communicator, visitor);
      }

      bool
      is_selected(unsigned int f) const
      {
        if (goal.selector.empty())
          return true;
        const auto &selections = mesh.patches[mesh.faces[f].patch].selections;
        return std::find(selections.begin(), selections.end(), what) != selections.end();
      }

      GoalFunctional
      divide(double measure, const std::string &problem)
      {
        std::vector<double> sum(1, measure);
        compare::sum_over_ranks(sum, communicator);
        if (!(sum[0] > 0.))
          throw core::InputError(what + ": " + problem + ".");
        return assembly.finish(sum[0], communicator);
      }

      GoalFunctional
      add_mean_stress(const Densities &densities, const std::string &problem)
      {
        double weights[6]               = {};
        weights[goal.component_index()] = 1.;
        const auto S                    = stress_weight(weights);
        double     measure              = 0.;
        visit_cells(
          densities,
          [&](unsigned int cell, const mesh::Barycentric &b, double weight, const double *values) {
            measure += weight * values[0];
            assembly.add_stress(cell, b, weight * values[0] * S);
          });
        return divide(measure, problem);
      }

      GoalFunctional
      add_mean_displacement()
      {
        Tensor<1, 3> unit;
        unit[goal.component_index()] = 1.;
        double measure               = 0.;
        visit_faces(
          weight(),
          [&](unsigned int cell, const mesh::Barycentric &b, double weight, const double *values) {
            measure += weight * values[0];
            assembly.add_force(cell, b, weight * values[0] * unit);
          });
        return divide(measure, "the integral of Weight over the chosen faces is not positive");
      }

      void
      add_functional()
      {
        const auto force
          = [&](unsigned int cell, const mesh::Barycentric &b, double w, const double *f) {
              assembly.add_force(cell, b, w * Tensor<1, 3>({f[0], f[1], f[2]}));
            };
        const auto displacement = expressions(goal.displacement_weight, "Displacement weight");
        if (!displacement.empty())
          visit_cells(densities_of(displacement), force);
        const auto traction = expressions(goal.traction_weight, "Traction weight");
        if (!traction.empty())
          visit_faces(densities_of(traction), force);
        const auto stress = expressions(goal.stress_weight, "Stress weight");
        if (!stress.empty())
          visit_cells(densities_of(stress),
                      [&](unsigned int             cell,
                          const mesh::Barycentric &b,
                          double                   w,
                          const double *s) { assembly.add_stress(cell, b, w * stress_weight(s)); });
      }

      const scene::GoalParameters &goal;
      const std::string            what; ///< its name in messages, and of its selection
      const mesh::NodalField      &field;
      const mesh::TetMesh         &mesh;
      Comparison                  &comparison;
      MPI_Comm                     communicator;
      GoalAssembly                 assembly;
      double                       diagonal = 0.;
    };
  } // namespace

  double
  GoalFunctional::value(const mesh::NodalField &field) const
  {
    double sum = offset;
    for (unsigned int i = 0; i < field.n_nodes(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        sum += forces[3 * static_cast<std::size_t>(i) + c] * field.values[i][c];
    return sum;
  }

  GoalFunctional
  put_on_mesh(const scene::GoalParameters &goal,
              const mesh::NodalField      &field,
              Comparison                  &comparison,
              const HierarchicalSurplus   *surplus)
  {
    return GoalOnMesh(goal, field, comparison, surplus).run();
  }

  std::vector<GoalValue>
  evaluate_goals(const scene::Scene &scene, Comparison &comparison)
  {
    std::vector<GoalValue> result;
    for (const auto &goal : scene.goals)
      {
        GoalValue value;
        value.name  = goal.name;
        value.value = put_on_mesh(goal, comparison.displacement(), comparison)
                        .value(comparison.displacement());
        value.exact = goal.exact;
        if (goal.exact)
          value.error = *goal.exact - value.value;
        result.push_back(value);
      }
    return result;
  }
} // namespace tetradapt::estimate
