// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/words.h"

namespace tetradapt::scene
{
  const Words<MeshSource> &
  words(MeshSource)
  {
    static const Words<MeshSource> table{{MeshSource::box, "box"},
                                         {MeshSource::bricks, "bricks"},
                                         {MeshSource::file, "file"},
                                         {MeshSource::surface, "surface"}};
    return table;
  }

  const Words<LoadType> &
  words(LoadType)
  {
    static const Words<LoadType> table{{LoadType::traction, "traction"},
                                       {LoadType::pressure, "pressure"},
                                       {LoadType::body_force, "body force"},
                                       {LoadType::gravity, "gravity"},
                                       {LoadType::temperature, "temperature"}};
    return table;
  }

  const Words<SolverParameters::Type> &
  words(SolverParameters::Type)
  {
    using Type = SolverParameters::Type;
    static const Words<Type> table{{Type::automatic, "automatic"},
                                   {Type::cg, "cg"},
                                   {Type::direct, "direct"}};
    return table;
  }

  const Words<ReferenceParameters::Type> &
  words(ReferenceParameters::Type)
  {
    using Type = ReferenceParameters::Type;
    static const Words<Type> table{{Type::none, "none"},
                                   {Type::fine_mesh, "fine mesh"},
                                   {Type::run, "earlier run"}};
    return table;
  }

  const Words<ReferenceParameters::MeshRoute> &
  words(ReferenceParameters::MeshRoute)
  {
    using Route = ReferenceParameters::MeshRoute;
    static const Words<Route> table{{Route::refine, "refine"},
                                    {Route::bricks, "bricks"},
                                    {Route::file, "file"}};
    return table;
  }

  const Words<AdaptivityParameters::Strategy> &
  words(AdaptivityParameters::Strategy)
  {
    using Strategy = AdaptivityParameters::Strategy;
    static const Words<Strategy> table{{Strategy::none, "none"},
                                       {Strategy::mesh_list, "mesh list"},
                                       {Strategy::uniform, "uniform"},
                                       {Strategy::adaptive, "adaptive"}};
    return table;
  }

  const Words<AdaptivityParameters::Driver> &
  words(AdaptivityParameters::Driver)
  {
    using Driver = AdaptivityParameters::Driver;
    static const Words<Driver> table{{Driver::energy, "energy"},
                                     {Driver::ren, "ren"},
                                     {Driver::exact, "exact"}};
    return table;
  }

  const Words<AdaptivityParameters::Marking> &
  words(AdaptivityParameters::Marking)
  {
    using Marking = AdaptivityParameters::Marking;
    static const Words<Marking> table{{Marking::maximum, "maximum"},
                                      {Marking::fixed_fraction, "fixed fraction"},
                                      {Marking::doerfler, "doerfler"},
                                      {Marking::optimal_size, "optimal size"}};
    return table;
  }

  const Words<AdaptivityParameters::Route> &
  words(AdaptivityParameters::Route)
  {
    using Route = AdaptivityParameters::Route;
    static const Words<Route> table{{Route::node_sizes, "node sizes"},
                                    {Route::volume_constraints, "volume constraints"}};
    return table;
  }
} // namespace tetradapt::scene
