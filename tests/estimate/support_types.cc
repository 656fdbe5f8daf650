// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Estimators with sliding and rigid supports. In an inclined block whose sides slide, each gives
// what it gives in the same block along the axes, whose components are fixed; with a rigid
// support that is moved as a whole, what it gives with fixed displacements; and zero where the
// solution is exact.

#include "tetradapt/estimate/estimator.h"
#include "tetradapt/scene/words.h"
#include "tetradapt/solve/static_solution.h"
#include "tetradapt/solve/static_system.h"

#include "../mechanics/bodies.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using scene::ErrorEstimator;
using scene::LoadType;
using scene::SupportType;

namespace
{
  using Vector3 = Tensor<1, 3>;

  /** A solution and what estimators ask for. */
  struct Case
  {
    Case(const scene::Scene &given, const mesh::TetMesh &body, const unsigned int degree)
      : scene(given)
    {
      auto mesh = std::make_shared<mesh::TetMesh>(body);
      select(*mesh, scene);
      materials         = std::make_unique<mechanics::MaterialMap>(scene, *mesh);
      const auto system = std::make_shared<solve::StaticSystem>(
        scene, *materials, mesh, degree, MPI_COMM_SELF, core::Log());
      solution        = system->solve(nullptr, {});
      solution.system = system;
      comparison      = std::make_unique<estimate::Comparison>(
        solution.displacement, *materials, scene.exact_solution, reference, MPI_COMM_SELF);
    }

    estimate::Estimate
    estimate(const ErrorEstimator which)
    {
      return estimate::make_estimator(which)->estimate({*comparison, scene, solution, {}});
    }

    scene::Scene                                      scene;
    solve::StaticSolution                             solution;
    std::unique_ptr<mechanics::MaterialMap>           materials;
    std::shared_ptr<const compare::ReferenceSampling> reference;
    std::unique_ptr<estimate::Comparison>             comparison;
  };

  /** An orthogonal matrix in no special direction; exact to rounding. */
  Tensor<2, 3>
  rotation()
  {
    const Vector3 a = Vector3({0.3, 0.8, -0.5}) / Vector3({0.3, 0.8, -0.5}).norm();
    Vector3       b({0.7, 0.1, 0.9});
    b -= (a * b) * a;
    b /= b.norm();
    const Vector3 c = cross_product_3d(a, b);
    Tensor<2, 3>  axes;
    for (unsigned int d = 0; d < 3; ++d)
      {
        axes[d][0] = a[d];
        axes[d][1] = b[d];
        axes[d][2] = c[d];
      }
    return axes;
  }

  /** The sum as text of the components of @p a times x, y and z. */
  std::string
  along(const Vector3 &a)
  {
    std::ostringstream text;
    text.precision(17);
    text << "((" << a[0] << ")*x + (" << a[1] << ")*y + (" << a[2] << ")*z)";
    return text.str();
  }

  scene::SupportParameters
  sliding(const std::string &name, const std::string &where)
  {
    scene::SupportParameters s = support(name, where);
    s.type                     = SupportType::sliding;
    return s;
  }

  void
  compare_cases(const std::string                 &title,
                Case                              &a,
                Case                              &b,
                const std::vector<ErrorEstimator> &estimators,
                const double                       tolerance)
  {
    std::cout << title << '\n';
    for (const ErrorEstimator which : estimators)
      {
        const estimate::Estimate first = a.estimate(which), second = b.estimate(which);
        double                   largest = 0.;
        for (std::size_t i = 0; i < first.indicators.size(); ++i)
          largest = std::max(largest, std::abs(first.indicators[i] - second.indicators[i]));
        check("  " + word(which) + ", something", first.global > 0.);
        check("  " + word(which), second.global, first.global, first.global, tolerance);
        check("  " + word(which) + ", cells", largest, 0., first.global, tolerance);
      }
  }

  void
  slides(const unsigned int degree)
  {
    const auto body     = box(Point<3>(2., 1., 1.5), {{4, 3, 3}});
    auto       inclined = std::make_shared<mesh::TetMesh>(*body);
    const auto R        = rotation();
    Vector3    axis[3];
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        axis[k][d] = R[d][k];
    for (auto &p : inclined->points)
      p = Point<3>(R * Vector3(p));

    scene::Scene scene;
    scene.materials        = {material("stuff", 20., 0.3)};
    scene.solver.tolerance = 1e-13;
    scene::GoalParameters goal;
    goal.name            = "end";
    goal.type            = scene::GoalType::functional;
    goal.selector.where  = "x > 2 - 1e-9";
    goal.traction_weight = {{"1 + y^2", "0", "0"}};
    scene.goals          = {goal};
    scene.supports       = {support("a", "x < 1e-9", "x"),
                            support("b", "y < 1e-9", "y"),
                            support("c", "z < 1e-9", "z")};
    scene.loads          = {load("end", LoadType::traction, "x > 2 - 1e-9", {{"1 + y", "0", "0"}}),
                            load("lid", LoadType::pressure, "z > 1.5 - 1e-9", {{"x*y", "", ""}})};
    Case along_axes(scene, *body, degree);

    const std::string  x = along(axis[0]), y = along(axis[1]), z = along(axis[2]);
    std::ostringstream text[3];
    for (unsigned int d = 0; d < 3; ++d)
      {
        text[d].precision(17);
        text[d] << "(1 + " << y << ")*(" << axis[0][d] << ")";
      }
    scene.supports
      = {sliding("a", x + " < 1e-9"), sliding("b and c", y + " < 1e-9 || " + z + " < 1e-9")};
    scene.loads                   = {load("end",
                        LoadType::traction,
                        x + " > 2 - 1e-9",
                        {{text[0].str(), text[1].str(), text[2].str()}}),
                                     load("lid", LoadType::pressure, z + " > 1.5 - 1e-9", {{x + "*" + y, "", ""}})};
    scene.goals[0].selector.where = x + " > 2 - 1e-9";
    for (unsigned int d = 0; d < 3; ++d)
      {
        std::ostringstream weight;
        weight.precision(17);
        weight << "(1 + " << y << "^2)*(" << axis[0][d] << ")";
        scene.goals[0].traction_weight[d] = weight.str();
      }
    Case turned(scene, *inclined, degree);
    compare_cases("Sliding sides, P" + std::to_string(degree),
                  along_axes,
                  turned,
                  {ErrorEstimator::spr,
                   ErrorEstimator::averaging,
                   ErrorEstimator::residual,
                   ErrorEstimator::interpolation,
                   ErrorEstimator::degree_extrapolation,
                   ErrorEstimator::local_degree_extrapolation,
                   ErrorEstimator::goal},
                  1e-6);
  }

  void
  moves(const unsigned int degree)
  {
    const auto   body = box(Point<3>(2., 1., 1.), {{4, 3, 3}});
    scene::Scene scene;
    scene.materials        = {material("stuff", 20., 0.3)};
    scene.solver.tolerance = 1e-13;
    scene.supports         = {support("wall", "x < 1e-9"),
                              support("end",
                              "x > 2 - 1e-9",
                              "xyz",
                              {{"0.01 + 0.02*(z - 1) - 0.03*(y - 0.5)",
                                        "-0.02 + 0.03*(x - 1) - 0.05*(z - 1)",
                                        "0.04 + 0.05*(y - 0.5) - 0.02*(x - 1)"}})};
    scene.loads = {load("lid", LoadType::pressure, "z > 1 - 1e-9 && x < 1.5", {{"x*y", "", ""}})};
    Case fixed(scene, *body, degree);
    scene.supports[1]                       = support("end", "x > 2 - 1e-9");
    scene.supports[1].type                  = SupportType::rigid;
    scene.supports[1].rigid.reference_point = Point<3>(1., 0.5, 1.);
    scene.supports[1].rigid.translation     = {{0.01, -0.02, 0.04}};
    scene.supports[1].rigid.rotation        = {{0.05, 0.02, 0.03}};
    Case coupled(scene, *body, degree);
    compare_cases("Rigid end, moved as a whole, P" + std::to_string(degree),
                  fixed,
                  coupled,
                  {ErrorEstimator::spr,
                   ErrorEstimator::averaging,
                   ErrorEstimator::residual,
                   ErrorEstimator::interpolation},
                  1e-8);
  }

  /** Tension by a force on a rigid end, nu = 0: nothing is left to estimate. */
  void
  exact(const unsigned int degree)
  {
    std::cout << "Rigid end under a force, exact, P" << degree << '\n';
    const auto   body = box(Point<3>(2., 1., 1.), {{4, 3, 3}});
    scene::Scene scene;
    scene.materials               = {material("stuff", 20., 0.)};
    scene.solver.tolerance        = 1e-13;
    scene.supports                = {support("wall", "x < 1e-9"), support("end", "x > 2 - 1e-9")};
    scene.supports[1].type        = SupportType::rigid;
    scene.supports[1].rigid.force = {{"2", "0", "0"}};
    Case         tension(scene, *body, degree);
    const double scale = std::sqrt(tension.solution.energy);
    for (const ErrorEstimator which : {ErrorEstimator::spr,
                                       ErrorEstimator::averaging,
                                       ErrorEstimator::residual,
                                       ErrorEstimator::interpolation})
      check("  " + word(which), tension.estimate(which).global, 0., scale, 1e-8);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize init(argc, argv, 1);
  for (const unsigned int degree : {1, 2})
    {
      slides(degree);
      moves(degree);
      exact(degree);
    }
}
