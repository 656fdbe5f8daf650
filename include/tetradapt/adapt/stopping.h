// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_stopping_h
#define tetradapt_adapt_stopping_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/scene/study_parameters.h"

#include <optional>
#include <string>
#include <vector>

namespace tetradapt::adapt
{
  /** Why the loop ends. */
  enum class StopReason
  {
    none, ///< it goes on
    tolerance,
    no_error,       ///< every indicator is zero
    one_mesh,       ///< the scene asks for one mesh
    end_of_list,    ///< the last mesh of a study is done
    saturation,     ///< the reference is as wrong as the mesh
    reference_mesh, ///< the mesh is as fine as the reference's
    max_cycles,
    max_tets,
    max_dofs,
    max_seconds,
    no_new_tets,
    no_better_mesh ///< meshes were rejected, and a uniform one would be too large
  };

  /** Whether a ratio of errors lets a reference measure a mesh. */
  enum class ReferenceTrust
  {
    unknown,  ///< no reference, or its own error is not known
    trusted,  ///< its error is at most a third of the mesh's
    doubtful, ///< above a third
    saturated ///< 0.7 of it and more: what is measured is the reference
  };

  /** What is known apart from the cycles' figures. */
  struct StoppingContext
  {
    unsigned int degree = 1; ///< of the solution
    /** Whether energy_error of the records is the true one: an exact displacement
     * or a known energy is given. */
    bool true_energy_error = false;
    /** Whether mean_ren is measured with an exact displacement. */
    bool true_ren = false;
    /** The reference's tetrahedra and degree; zero tetrahedra: no reference. */
    unsigned long reference_tets         = 0;
    unsigned int  reference_degree       = 0;
    bool          reference_is_hexahedra = false;
    /** Whether errors leave out a part of the body. */
    bool leaves_out = false;
    /** The goal that Goal tolerance is about: Estimation/Goal; empty: the first. */
    std::string goal;
    /** Strategy::mesh_list: the number of meshes. */
    unsigned int n_meshes = 0;
    /** Wall time since the run began, seconds. */
    double elapsed_seconds = 0.;
  };

  /** Whether to stop, in a form for programs and one for people. */
  struct StopDecision
  {
    StopReason reason = StopReason::none;
    /** Only a tolerance that was really reached, or the regular end of what the
     * scene asked for; never a limit or saturation. */
    bool        success = false;
    std::string text; ///< one sentence for the user; empty while the loop goes on
    /** What the user must know about this cycle's figures even if the loop goes
     * on, each a sentence. */
    std::vector<std::string> warnings;

    bool
    stop() const
    {
      return reason != StopReason::none;
    }
  };

  /**
   * How far the reference can be trusted for a mesh: e_ref <= e_h/3 makes an
   * error of at most a few per cent in a measured e_h; from 0.7 on, the
   * difference between the two solutions says more about the reference.
   *
   * @param reference_error, mesh_error relative or absolute, both alike.
   */
  ReferenceTrust
  reference_trust(const std::optional<double> &reference_error,
                  const std::optional<double> &mesh_error);

  /**
   * Decides after a cycle whether the loop ends, and why. The rules, first match:
   * the tolerances that are set are all reached, with a reference that is better
   * than what it measures; the scene's meshes are done; saturation; a mesh as
   * fine as the reference's; limits on cycles, tetrahedra, unknowns and time; no
   * new tetrahedra. Saturation does not end a run without a safeguard; it and the reference's
   * size never cut a list of meshes short, nor a uniform study whose true error is known: they are
   * warnings there.
   *
   * The error held against the tolerance is the true one where it is known, else
   * sqrt(estimate^2 + reference_error^2), relative.
   *
   * A pure function. @p history has one record a finished cycle, in order.
   */
  StopDecision
  decide_stop(const scene::AdaptivityParameters &parameters,
              const StoppingContext             &context,
              const std::vector<CycleRecord>    &history);

  /** The decision when there is nothing left to refine, before TetGen is run:
   * @p largest_indicator is zero, or the size field refines no cell. */
  StopDecision
  decide_nothing_to_refine(double largest_indicator);

  /** The decision once TetGen has returned a mesh of @p new_tets tetrahedra. */
  StopDecision
  decide_new_mesh(unsigned long old_tets, unsigned long new_tets);

  /** Whether each tetrahedron of cycle @p last, from which a mesh was made twice and
   * rejected, may be cut into eight within the limits. */
  StopDecision
  decide_uniform_fallback(const scene::AdaptivityParameters &parameters, const CycleRecord &last);
} // namespace tetradapt::adapt

#endif
