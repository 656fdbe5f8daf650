// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/study_parameters.h"

#include "binder.h"
#include "require.h"

#include <filesystem>

namespace tetradapt::scene
{
  namespace
  {
    void
    bind_rules(AdaptivityParameters &p, Binder &binder)
    {
      binder("Lambda",
             p.lambda,
             number_codec(),
             "maximum: marks where the error is at least this fraction of the largest.");
      binder(
        "Minimum new fraction",
        p.min_new,
        number_codec(),
        "maximum: Lambda is lowered until at least this fraction of the tetrahedra is marked.");
      binder("Fraction",
             p.fraction,
             number_codec(),
             "fixed fraction: fraction of the tetrahedra to mark, those with the largest errors.");
      binder("Theta",
             p.theta,
             number_codec(),
             "doerfler: fraction of the squared error that the marked tetrahedra hold.");
      binder("Reduction",
             p.reduction,
             number_codec(),
             "maximum, fixed fraction, doerfler: new edge length of a marked tetrahedron over "
             "its old one.");
      binder("Growth",
             p.growth,
             number_codec(),
             "optimal size: ratio of the next mesh's tetrahedra to this one's; fewer if they reach "
             "the tolerance, up to half as many more if only these do.");
      binder("Minimum ratio",
             p.min_ratio,
             number_codec(),
             "Smallest new edge length over the old one in one cycle.");
      binder("Maximum ratio",
             p.max_ratio,
             number_codec(),
             "Largest new edge length over the old one in one cycle.");
      binder("Minimum size", p.min_size, number_codec(), "Smallest edge length; 0: none.");
      binder("Maximum size", p.max_size, number_codec(), "Largest edge length; 0: none.");
      binder("Gradation",
             p.gradation,
             number_codec(),
             "Largest growth of the edge length per unit of distance.");
      binder("Safeguard",
             p.safeguard,
             yes_no_codec(),
             "adaptive: do not accept a mesh whose energy says that the solution became worse: "
             "refine the one before more strongly, then uniformly. Also stop when the reference "
             "that drives the refinement (energy, ren) is hardly better than the mesh: when its "
             "error is at least 0.7 times the mesh's.");
      binder("Coarsening",
             p.coarsening,
             yes_no_codec(),
             "adaptive: let elements grow where the error is small, by meshing the body from "
             "scratch with "
             "the wanted sizes instead of refining the old mesh.");
    }

    void
    bind(AdaptivityParameters &p, Binder &binder)
    {
      binder("Strategy",
             p.strategy,
             word_codec<AdaptivityParameters::Strategy>(),
             "none: one mesh. mesh list: one cycle for each mesh that Mesh lists. uniform: every "
             "tetrahedron cut into 8 each cycle. adaptive: refined where the error is.");
      binder("Refinement indicator",
             p.refinement_indicator,
             word_codec<ErrorEstimator>(),
             "adaptive: which error drives the refinement. energy, ren: the difference to the "
             "reference in the energy norm, or as relative nodal error. exact: the true error "
             "(needs Exact solution/Displacement). goal: of Estimation/Goal. The others need "
             "nothing but "
             "the solution.");
      binder("Marking",
             p.marking,
             word_codec<AdaptivityParameters::Marking>(),
             "adaptive: how new sizes follow from errors: by marking tetrahedra, or (optimal size) "
             "by distributing the error evenly over a given number of tetrahedra.");
      binder("Size control",
             p.size_control,
             word_codec<AdaptivityParameters::SizeControl>(),
             "adaptive: how TetGen gets the sizes: an edge length at every node, or a largest "
             "volume for every tetrahedron.");
      bind_rules(p, binder);
      binder("Tolerance",
             p.tolerance,
             number_codec(),
             "Stop when the relative error in the energy norm is below this; 0: no tolerance.");
      binder("REN tolerance",
             p.ren_tolerance,
             number_codec(),
             "Stop when the mean REN is below this; 0: no tolerance.");
      binder("Goal tolerance",
             p.goal_tolerance,
             number_codec(),
             "Stop when the relative error of Estimation/Goal is below this; 0: no tolerance.");
      binder("Maximum cycles",
             p.max_cycles,
             count_codec(),
             "uniform, adaptive: stop after this many cycles, the first mesh included.");
      binder("Maximum tetrahedra",
             p.max_tets,
             long_count_codec(),
             "No cycle with a larger mesh; optimal sizes aim at no more. 0: no limit.");
      binder("Maximum unknowns",
             p.max_dofs,
             long_count_codec(),
             "No cycle with a larger system; 0: no limit.");
      binder("Maximum seconds",
             p.max_seconds,
             number_codec(),
             "No new cycle after that time; 0: no limit.");
    }

    void
    bind(OutputParameters &p, Binder &binder)
    {
      binder("Directory",
             p.directory,
             text_codec("the name of a folder"),
             "Where results go; empty: output/ and the scene's name, below the working "
             "directory.");
      binder("Tables", p.tables, yes_no_codec(), "Write convergence.csv and convergence.txt.");
      binder("VTU", p.vtu, yes_no_codec(), "Write a .vtu file per cycle and the .pvd.");
      binder("Stress", p.stress, yes_no_codec(), "Stress and von Mises stress in the .vtu.");
      binder("Plots", p.plots, yes_no_codec(), "Draw convergence and errors (SVG, by gnuplot).");
      binder("Size field",
             p.size_field,
             yes_no_codec(),
             "Write size_field.vtu, the sizes that the run ends with: another scene can start from "
             "it by Mesh/Size field.");
    }

    void
    check_fraction(const double value, const std::string &name)
    {
      require(value > 0. && value <= 1.,
              "Adaptivity/" + name,
              "must be larger than 0 and at most 1, not " + text_of(value) + ".");
    }

    void
    check_not_negative(const double value, const std::string &name, const std::string &zero)
    {
      require(value >= 0.,
              "Adaptivity/" + name,
              "must be positive, or 0 for " + zero + "; it is " + text_of(value) + ".");
    }
  } // namespace

  void
  AdaptivityParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  AdaptivityParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  AdaptivityParameters::check() const
  {
    Mistakes mistakes;
    mistakes.attempt([&]() { check_fraction(lambda, "Lambda"); });
    mistakes.attempt([&]() { check_fraction(fraction, "Fraction"); });
    mistakes.attempt([&]() { check_fraction(theta, "Theta"); });
    mistakes.attempt([&]() { check_fraction(min_ratio, "Minimum ratio"); });
    mistakes.require(min_new >= 0. && min_new <= 1.,
                     "Adaptivity/Minimum new fraction",
                     "must be between 0 and 1, not " + text_of(min_new) + ".");
    mistakes.require(reduction > 0. && reduction < 1.,
                     "Adaptivity/Reduction",
                     "must be between 0 and 1: a marked tetrahedron becomes smaller; it is "
                       + text_of(reduction) + ".");
    mistakes.require(growth > 1.,
                     "Adaptivity/Growth",
                     "must be larger than 1: the next mesh has more tetrahedra; it is "
                       + text_of(growth) + ".");
    mistakes.require(max_ratio >= 1.,
                     "Adaptivity/Maximum ratio",
                     "must be at least 1; it is " + text_of(max_ratio) + ".");
    mistakes.attempt([&]() { check_not_negative(min_size, "Minimum size", "none"); });
    mistakes.attempt([&]() { check_not_negative(max_size, "Maximum size", "none"); });
    mistakes.require(max_size == 0. || min_size <= max_size,
                     "Adaptivity/Minimum size",
                     text_of(min_size) + " is larger than Maximum size, " + text_of(max_size)
                       + ".");
    mistakes.require(gradation > 0.,
                     "Adaptivity/Gradation",
                     "must be positive; 0.2 to 0.4 is usual, and large values allow any jump.");
    mistakes.attempt([&]() { check_not_negative(tolerance, "Tolerance", "no such stop"); });
    mistakes.require(tolerance < 1.,
                     "Adaptivity/Tolerance",
                     "is a relative error: it must be smaller than 1, such as 0.05.");
    mistakes.attempt([&]() { check_not_negative(ren_tolerance, "REN tolerance", "no such stop"); });
    mistakes.attempt(
      [&]() { check_not_negative(goal_tolerance, "Goal tolerance", "no such stop"); });
    mistakes.require(max_cycles > 0, "Adaptivity/Maximum cycles", "must be at least 1.");
    mistakes.attempt([&]() { check_not_negative(max_seconds, "Maximum seconds", "no limit"); });
    mistakes.throw_together();
  }

  void
  OutputParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  OutputParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  OutputParameters::check() const
  {
    std::error_code error;
    require(directory.empty() || !std::filesystem::is_regular_file(directory, error),
            "Output/Directory",
            "'" + directory + "' is a file. Give the name of a folder; it is made if needed.");
  }
} // namespace tetradapt::scene
