// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The solver alone, on the clamped beam 10 x 1 x 1 in equal tetrahedra:
//
//   tetradapt_solver_benchmark <subdivisions> [degree [nu [contrast [distortion [product
//     [direct [flatness [trilinos]]]]]]]]
//
// prints one line of CSV with a header: unknowns, iterations to 1e-8, seconds of set-up
// (edges, supports, numbering, matrix, preconditioner) and of the solve (iterations,
// energies), and of one product with the assembled matrix (best of twenty) if product
// is 1, also in single precision and matrix-free; the sparse Cholesky factorisation solves if
// direct is 1. CPU seconds, the largest of all ranks, and wall seconds of the first two. A contrast
// makes the half x > 5 that many times stiffer; a distortion moves inner points by up to that part
// of a brick; a flatness makes the beam that many times thinner in z, and so its cells flat;
// multigrid is that of Trilinos if trilinos is 1.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/block_rows.h"
#include "tetradapt/solve/static_solution.h"
#include "tetradapt/solve/static_system.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>

namespace
{
  using namespace tetradapt;
  using dealii::Point;

  struct Seconds
  {
    double cpu = 0., wall = 0.;
  };

  /** What @p action takes, the largest of all ranks. */
  template <typename Action>
  Seconds
  measure(const Action &action)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const auto cpu = [] {
      timespec time;
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
      return time.tv_sec + 1e-9 * time.tv_nsec;
    };
    const auto   wall      = std::chrono::steady_clock::now();
    const double cpu_begin = cpu();
    action();
    Seconds seconds{cpu() - cpu_begin,
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
    seconds.cpu  = dealii::Utilities::MPI::max(seconds.cpu, MPI_COMM_WORLD);
    seconds.wall = dealii::Utilities::MPI::max(seconds.wall, MPI_COMM_WORLD);
    return seconds;
  }

  std::shared_ptr<mesh::TetMesh>
  beam(unsigned int n, double distortion, double flatness)
  {
    auto body = std::make_shared<mesh::TetMesh>(
      mesh::bricks(Point<3>(), Point<3>(10, 1, 1), {{10 * n, n, n}}));
    for (unsigned int c = 0; c < body->n_cells(); ++c)
      {
        double x = 0.;
        for (const unsigned int p : body->cells[c])
          x += 0.25 * body->points[p][0];
        body->regions[c] = x > 5. ? 1 : 0;
      }
    double phase = 0.;
    for (auto &p : body->points)
      for (unsigned int d = 0; d < 3; ++d)
        if (p[d] > 1e-9 && p[d] < (d == 0 ? 10. : 1.) - 1e-9 && std::abs(p[0] - 5.) > 1e-9)
          p[d] += distortion / n * std::sin(phase += 1.7);
    for (auto &p : body->points)
      p[2] /= flatness;
    mesh::finalize(*body, "beam");
    return body;
  }

  scene::Scene
  cantilever(double nu, double contrast, bool direct)
  {
    scene::Scene scene;
    scene.materials.resize(2);
    for (unsigned int i = 0; i < 2; ++i)
      {
        scene.materials[i].name                       = i == 0 ? "beam" : "tip";
        scene.materials[i].constants["Young modulus"] = i == 0 ? 1000. : 1000. * contrast;
        scene.materials[i].constants["Poisson ratio"] = nu;
      }
    scene.materials[1].regions = {1};
    scene.supports.resize(1);
    scene.supports[0].name           = "clamp";
    scene.supports[0].selector.where = "x < 1e-9";
    scene.loads.resize(1);
    scene.loads[0].name           = "tip";
    scene.loads[0].type           = scene::LoadType::traction;
    scene.loads[0].selector.where = "x > 10 - 1e-9";
    scene.loads[0].value          = {{"0", "0", "-1"}};
    scene.solver.type
      = direct ? scene::SolverParameters::Type::direct : scene::SolverParameters::Type::cg;
    return scene;
  }

  /** CPU seconds of one product, the best of twenty. */
  template <typename Number>
  double
  time_of_product(const mechanics::LinearOperator<Number> &matrix)
  {
    mechanics::VectorOf<Number> x(matrix.vector_layout()), y(x);
    x           = 1;
    double best = 1e30;
    for (unsigned int repetition = 0; repetition < 20; ++repetition)
      best = std::min(best, measure([&] { matrix.vmult(y, x); }).cpu);
    return best;
  }

  /** Of the assembled matrix; in single precision; and matrix-free in double and single. */
  std::array<double, 4>
  times_of_products(const scene::Scene                         &scene,
                    const mechanics::MaterialMap               &materials,
                    const std::shared_ptr<const mesh::TetMesh> &body,
                    unsigned int                                degree)
  {
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const mechanics::TangentField tangents(materials, *body);
    const mesh::EdgeTable         edges = mesh::build_edges(*body);
    const fem::Space              space(triangulation, degree);
    const fem::FixedUnknowns      fixed(
      space,
      mechanics::make_constraints(mechanics::prescribe(scene.supports, *body, &edges), space));
    const auto  system = mechanics::assemble(space, tangents, fixed);
    const auto &matrix = system.matrix;

    solve::BlockRows<3, 3> rows;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      rows.begin.push_back(matrix.row_end(row));
    for (std::size_t k = 0; k < matrix.n_blocks(); ++k)
      {
        rows.columns.push_back(matrix.column(k));
        rows.blocks.push_back(matrix.block(k));
      }
    std::array<double, 4> times{
      {time_of_product(matrix),
       time_of_product(solve::BlockOperator<float, 3>(rows, space.vector_layout())),
       0.,
       0.}};
    if (degree == 2)
      {
        times[2] = time_of_product(mechanics::MatrixFreeStiffness<double>(space, tangents, fixed));
        times[3] = time_of_product(mechanics::MatrixFreeStiffness<float>(space, tangents, fixed));
      }
    return times;
  }

  void
  run(int argc, char *argv[])
  {
    const auto argument
      = [&](int i, double value) { return argc > i ? std::stod(argv[i]) : value; };
    const unsigned int n = argument(1, 8), degree = argument(2, 2);
    scene::Scene       scene = cantilever(argument(3, 0.3), argument(4, 1.), argument(7, 0.) > 0.);
    if (argument(9, 0.) > 0.)
      scene.solver.multigrid = scene::SolverParameters::Multigrid::trilinos;
    const auto body = beam(n, argument(5, 0.), argument(8, 1.));
    mesh::select_faces(*body, mesh::face_selectors(scene));
    const mechanics::MaterialMap materials(scene, *body);

    std::unique_ptr<solve::StaticSystem> system;
    solve::StaticSolution                solution;
    const Seconds                        set_up = measure([&] {
      system = std::make_unique<solve::StaticSystem>(
        scene, materials, body, degree, MPI_COMM_WORLD, core::Log());
    });
    const Seconds solving = measure([&] { solution = system->solve(nullptr, {}); });
    system.reset();
    std::array<double, 4> products{};
    if (argument(6, 0.) > 0.)
      products = times_of_products(scene, materials, body, degree);
    const double product = products[0];
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "degree,unknowns,iterations,set_up_cpu,solve_cpu,set_up_wall,solve_wall,"
                   "product_cpu,products,cpu_per_million,energy,single_product_cpu,"
                   "matrix_free_product_cpu,matrix_free_single_product_cpu\n"
                << degree << ',' << solution.n_dofs << ',' << solution.iterations << ','
                << set_up.cpu << ',' << solving.cpu << ',' << set_up.wall << ',' << solving.wall
                << ',' << product << ','
                << (product > 0. ? (set_up.cpu + solving.cpu) / product : 0.) << ','
                << (set_up.cpu + solving.cpu) / solution.n_dofs * 1e6 << ',' << solution.energy
                << ',' << products[1] << ',' << products[2] << ',' << products[3] << std::endl;
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      run(argc, argv);
    }
  catch (const std::exception &error)
    {
      std::cerr << "Error: " << error.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
}
