// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_words_h
#define tetradapt_scene_words_h

#include "tetradapt/scene/goal_parameters.h"
#include "tetradapt/scene/mesh_parameters.h"
#include "tetradapt/scene/model_parameters.h"
#include "tetradapt/scene/study_parameters.h"

#include <string>
#include <utility>
#include <vector>

namespace tetradapt::scene
{
  /** The words by which scene files and messages call the values of an
   * enumeration. */
  template <class E>
  using Words = std::vector<std::pair<E, std::string>>;

  /** All words of the argument's type; its value does not matter. */
  const Words<Formulation>                       &words(Formulation);
  const Words<MeshSource>                        &words(MeshSource);
  const Words<GoalType>                          &words(GoalType);
  const Words<ErrorEstimator>                    &words(ErrorEstimator);
  const Words<MeshParameters::Projection>        &words(MeshParameters::Projection);
  const Words<SolverParameters::Stopping>        &words(SolverParameters::Stopping);
  const Words<SolverParameters::Multigrid>       &words(SolverParameters::Multigrid);
  const Words<SupportType>                       &words(SupportType);
  const Words<SpringDirection>                   &words(SpringDirection);
  const Words<LoadType>                          &words(LoadType);
  const Words<Distribution>                      &words(Distribution);
  const Words<SolverParameters::Type>            &words(SolverParameters::Type);
  const Words<ReferenceParameters::Type>         &words(ReferenceParameters::Type);
  const Words<ReferenceParameters::MeshRoute>    &words(ReferenceParameters::MeshRoute);
  const Words<AdaptivityParameters::Strategy>    &words(AdaptivityParameters::Strategy);
  const Words<AdaptivityParameters::Marking>     &words(AdaptivityParameters::Marking);
  const Words<AdaptivityParameters::SizeControl> &words(AdaptivityParameters::SizeControl);

  /** The word for @p value, for example "optimal size". */
  template <class E>
  std::string
  word(const E value)
  {
    for (const auto &entry : words(value))
      if (entry.first == value)
        return entry.second;
    return "";
  }
} // namespace tetradapt::scene

#endif
