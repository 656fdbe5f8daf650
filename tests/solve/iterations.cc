// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The parts of the solver on small matrices whose answers are known: conjugate gradients and
// their control, which NaN never ends as success; the smoother's eigenvalue; the inverses of
// blocks; aggregates; and the preconditioner in single precision that gives way to one in double.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/solve/aggregation.h"
#include "tetradapt/solve/chebyshev.h"
#include "tetradapt/solve/conjugate_gradients.h"
#include "tetradapt/solve/linear_solver.h"

#include "solving.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/vector.h>

#include <limits>
#include <map>

using namespace bodies;
using namespace solve;

namespace
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  using PlainVector = dealii::Vector<double>;

  /** The matrix of a chain of springs, tridiagonal with -1, 2, -1, one entry replaced. */
  struct Chain
  {
    unsigned int n;
    double       first = 2.; ///< entry 0, 0

    void
    vmult(PlainVector &y, const PlainVector &x) const
    {
      for (unsigned int i = 0; i < n; ++i)
        y[i] = (i == 0 ? first : 2.) * x[i] - (i > 0 ? x[i - 1] : 0.) - (i + 1 < n ? x[i + 1] : 0.);
    }
  };

  /** A preconditioner that is negative. */
  struct Negative
  {
    void
    vmult(PlainVector &y, const PlainVector &x) const
    {
      y.equ(-1., x);
    }
  };

  struct Broken
  {
    void
    vmult(PlainVector &y, const PlainVector &x) const
    {
      y    = x;
      y[1] = nan;
    }
  };

  std::string
  word(const Ending ending)
  {
    return ending == Ending::converged      ? "converged"
           : ending == Ending::stopped      ? "stopped"
           : ending == Ending::not_positive ? "not positive"
           : ending == Ending::indefinite   ? "indefinite"
                                            : "not finite";
  }

  template <typename Matrix, typename Preconditioner>
  void
  run(const std::string     &what,
      const Matrix          &matrix,
      const Preconditioner  &preconditioner,
      const PlainVector     &b,
      const IterationLimits &limits)
  {
    EnergyControl control(limits);
    PlainVector   x(b.size());
    const Ending  ending = conjugate_gradients(matrix, preconditioner, b, control, x);
    std::cout << what << ": " << word(ending)
              << (control.result().iterations <= 3 ? " wihalves three iterations" : "")
              << (std::isfinite(x.l2_norm()) ? "" : ", and x is NOT FINITE") << '\n';
  }

  void
  conjugate_gradients_on_a_chain()
  {
    const unsigned int n = 40;
    const Chain        chain{n};
    PlainVector        exact(n), b(n), x(n);
    for (unsigned int i = 0; i < n; ++i)
      exact[i] = std::sin(1. + i);
    chain.vmult(b, exact);
    const dealii::PreconditionIdentity none;
    IterationLimits                    limits;
    limits.residual       = 1e-12 * b.l2_norm();
    limits.max_iterations = 100;
    EnergyControl control(limits);
    std::cout << "chain: " << word(conjugate_gradients(chain, none, b, control, x)) << '\n';
    const IterationResult result = control.result();
    x -= exact;
    check("  solution", x.linfty_norm(), 0., 1., 1e-10);
    check("  gained is the energy", result.gained, exact * b, exact * b, 1e-10);
    check("  at most as many iterations as unknowns", result.iterations <= n);

    // The error in energy is known: the estimate ends the iteration near it.
    limits                = IterationLimits();
    limits.error          = 0.02 * std::sqrt(exact * b);
    limits.max_iterations = 100;
    EnergyControl early(limits);
    x = 0.;
    conjugate_gradients(chain, none, b, early, x);
    PlainVector rest(exact), force(n);
    rest -= x;
    chain.vmult(force, rest);
    const double error = std::sqrt(rest * force);
    check("  ended by its error, wihalves a factor of three",
          error < 3. * limits.error && early.result().error <= limits.error
            && early.result().iterations < result.iterations);

    limits                = IterationLimits();
    limits.residual       = 1e-12 * b.l2_norm();
    limits.max_iterations = 5;
    run("too few iterations", chain, none, b, limits);
    limits.max_iterations = 100;
    run("a negative eigenvalue", Chain{n, -50.}, none, b, limits);
    run("NaN in the matrix", Chain{n, nan}, none, b, limits);
    run("NaN in the preconditioner", chain, Broken(), b, limits);
    run("a negative preconditioner", chain, Negative(), b, limits);
    PlainVector broken(b);
    broken[3] = nan;
    run("NaN in the load", chain, none, broken, limits);
    run("no load", chain, none, PlainVector(n), limits);
  }

  /** Blocks of a chain along x, the same in each component. */
  template <typename Number>
  class BlockChain : public mechanics::LinearOperator<Number>
  {
  public:
    explicit BlockChain(const unsigned int n)
    {
      dealii::IndexSet all(3 * n);
      all.add_range(0, 3 * n);
      layout = std::make_shared<dealii::Utilities::MPI::Partitioner>(all, MPI_COMM_SELF);
    }
    void
    vmult(VectorOf<Number> &y, const VectorOf<Number> &x) const override
    {
      const unsigned int size = layout->locally_owned_size();
      for (unsigned int i = 0; i < size; ++i)
        y.local_element(i) = 2 * x.local_element(i) - (i >= 3 ? x.local_element(i - 3) : 0)
                             - (i + 3 < size ? x.local_element(i + 3) : 0);
    }
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_layout() const override
    {
      return layout;
    }

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
  };

  template <typename Number>
  void
  smoother(const std::string &precision)
  {
    const unsigned int                       n = 50;
    const BlockChain<Number>                 matrix(n);
    const std::array<Number, 9>              block{{2, 0, 0, 0, 2, 0, 0, 0, 2}};
    const std::vector<std::array<Number, 9>> blocks(n, block);
    const auto                               inverses = invert_blocks<Number, 3>(blocks);
    const ChebyshevSmoother<Number, 3>       smooth(matrix, inverses, 3);
    const double largest = 1. - std::cos(dealii::numbers::PI * n / (n + 1)); // of D^-1 A
    check("largest eigenvalue, " + precision + ": at least 0.99, at most 1.15 of it",
          smooth.largest_eigenvalue() >= 0.99 * largest
            && smooth.largest_eigenvalue() <= 1.15 * largest);

    // Of an error that alternates from node to node little is left.
    VectorOf<Number> x(matrix.vector_layout()), b(x);
    for (unsigned int i = 0; i < 3 * n; ++i)
      x.local_element(i) = i / 3 % 2 == 0 ? 1 : -1;
    const double before = x.l2_norm();
    smooth.step(x, b);
    check("  a sweep takes nine tenths of an alternating error", x.l2_norm() < 0.1 * before);
  }

  template <typename Number, unsigned int n>
  void
  blocks(const std::string &what, const double tolerance)
  {
    std::vector<std::array<Number, n * n>> blocks(2);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          blocks[0][n * i + j] = 1. / (1. + i + j) + (i == j ? 1. : 0.); // positive
          blocks[1][n * i + j] = i == j ? 4. : i + j == 1 ? 5. : 0.;     // not positive
        }
    const auto inverses = invert_blocks<Number, n>(blocks);
    double     worst    = 0.;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          double sum = 0.;
          for (unsigned int k = 0; k < n; ++k)
            sum += double(blocks[0][n * i + k]) * inverses[0][n * k + j];
          worst = std::max(worst, std::abs(sum - (i == j ? 1. : 0.)));
        }
    check(what + ": inverse", worst, 0., 1., tolerance);
    bool diagonal = true;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        diagonal = diagonal && inverses[1][n * i + j] == (i == j ? Number(0.25) : Number(0));
    check("  taken for its diagonal where it is not positive", diagonal);
  }

  /** Nodes coupled strongly in two chains, weakly between them, and one without couplings. */
  void
  aggregates()
  {
    const unsigned int n = 9; // of a chain
    BlockRows<3, 3>    rows;
    const auto         add = [&](const unsigned int column, const double value) {
      rows.columns.push_back(column);
      rows.blocks.push_back({{value, 0, 0, 0, value, 0, 0, 0, value}});
    };
    for (unsigned int node = 0; node < 2 * n; ++node)
      {
        add(node, 2.);
        const unsigned int k = node % n;
        if (k > 0)
          add(node - 1, -1.);
        if (k + 1 < n)
          add(node + 1, -1.);
        add(node < n ? node + n : node - n, -0.01);
        rows.begin.push_back(rows.columns.size());
      }
    add(2 * n, 1.);
    rows.begin.push_back(rows.columns.size());
    const Aggregates                     sets = aggregate<3>(rows, 0.1);
    bool                                 all = true, apart = true, small = true;
    std::map<unsigned int, unsigned int> sizes;
    for (unsigned int node = 0; node < 2 * n; ++node)
      {
        all = all && sets.of_node[node] < sets.count;
        ++sizes[sets.of_node[node]];
        for (unsigned int other = 0; other < 2 * n; ++other)
          apart = apart && (node / n == other / n || sets.of_node[node] != sets.of_node[other]);
      }
    for (const auto &[set, size] : sizes)
      small = small && size >= 2 && size <= 5;
    check("aggregates: every coupled node is in one", all);
    check("  weak couplings are not followed", apart);
    check("  they have two to five nodes of a chain", small);
    check("  a node without couplings has none", sets.of_node[2 * n] == no_aggregate);
  }

  /** A preconditioner in single precision that loses everyhalvesg is made again in double. */
  void
  fallback()
  {
    // A half so soft that its stiffness is zero in single precision.
    scene::Scene scene;
    scene.materials            = {material("stiff", 1e3, 0.3), material("soft", 1e-45, 0.3)};
    scene.materials[1].regions = {1};
    scene.supports             = {support("wall", "x < 1e-9")};
    scene.loads = {load("tip", scene::LoadType::traction, "x > 1-1e-9", {{"0", "0", "1e-45"}})};
    scene.solver.type = SolverType::cg;
    const auto body   = box(Point<3>(1, 1, 1), {{4, 4, 4}}, 0.2, 0.5);
    select(*body, scene);
    const mechanics::MaterialMap halves(scene, *body);
    core::Log                    log;
    bool                         is_double = false;
    log.add_sink([&](core::LogLevel, const std::string &text) {
      is_double = is_double || text.find("double precision") != std::string::npos;
    });
    const double cg    = solve::solve_static(scene, halves, body, 2, MPI_COMM_WORLD, log).energy;
    scene.solver.type  = SolverType::direct;
    const double exact = solve_scene(scene, body, 2).energy;
    check("the preconditioner was made again in double precision", is_double);
    check("conjugate gradients and the factorisation agree", cg, exact, exact, 1e-7);

    const core::Log silent;
    using mechanics::MaterialMap;
    const MaterialMap     materials(scene, *body);
    const mesh::EdgeTable edges = mesh::build_edges(*body);
    const auto triangulation    = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const fem::Space       space(triangulation, 2);
    const fem::Constraints constraints
      = mechanics::make_constraints(mechanics::prescribe(scene.supports, *body, &edges), space);
    std::vector<Tensor<1, 3>> forces(space.n_field_nodes());
    for (auto &force : forces)
      force[2] = 1.;
    const auto refusal = [&](const std::string &what, const double modulus, const SolverType type) {
      const auto                    C = modulus * materials.linear_law(0).tangent_at_rest();
      const mechanics::TangentField tangents({C}, std::vector<unsigned int>(body->n_cells(), 0), 1);
      scene.solver.type = type;
      std::cout << what << ": ";
      try
        {
          const LinearSolver solver({space, tangents, constraints}, scene.solver, silent);
          Vector             x(space.vector_layout());
          solver.solve(solver.right_hand_side(fem::distribute(space, forces)), {}, "The loads", x);
          std::cout << "SOLVED\n";
        }
      catch (const core::NumericalError &)
        {
          std::cout << "refused\n";
        }
    };
    refusal("a law that gives NaN, conjugate gradients", nan, SolverType::cg);
    refusal("a law that gives NaN, factorised", nan, SolverType::direct);
    refusal("a law that gives NaN, automatic", nan, SolverType::automatic);
    forces[1][1] = nan; // of a node that is free
    refusal("a load that is NaN, conjugate gradients", 1., SolverType::cg);
    refusal("a load that is NaN, factorised", 1., SolverType::direct);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  conjugate_gradients_on_a_chain();
  smoother<double>("double");
  smoother<float>("single");
  blocks<double, 3>("3 x 3", 1e-14);
  blocks<double, 6>("6 x 6", 1e-13);
  blocks<float, 3>("3 x 3, single", 1e-6);
  aggregates();
  fallback();
}
