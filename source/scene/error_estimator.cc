// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/error_estimator.h"

#include "binder.h"
#include "require.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    void
    bind(EstimationParameters &p, Binder &binder)
    {
      binder("Estimators",
             p.estimators,
             words_codec<ErrorEstimator>(),
             "Estimators that every cycle computes for the tables in addition to the refinement "
             "indicator.");
      binder("Goal",
             p.goal,
             text_codec("the name of a subsection of Goals, or nothing"),
             "The goal that the estimator 'goal' is about; empty: the first.");
    }
  } // namespace

  void
  EstimationParameters::declare(dealii::ParameterHandler &prm) const
  {
    declare_bound(*this, prm, bind);
  }

  void
  EstimationParameters::parse(dealii::ParameterHandler &prm)
  {
    parse_bound(*this, prm, bind);
  }

  void
  EstimationParameters::check() const
  {
    for (auto e = estimators.begin(); e != estimators.end(); ++e)
      require(std::find(estimators.begin(), e, *e) == e,
              "Estimation/Estimators",
              "'" + word(*e) + "' is listed twice. Remove one.");
  }
} // namespace tetradapt::scene
