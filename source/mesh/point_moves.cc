// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/point_moves.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr double       good_enough = 0.2; ///< mean ratio that a cell may always have
    constexpr double       good        = 0.5; ///< mean ratio above which none is smoothed
    constexpr double       least_way   = 0.1; ///< part of a way below which a point stays
    constexpr unsigned int n_sweeps    = 4;   ///< of smoothing, before ways are halved
    constexpr unsigned int most_rounds = 12;

    /** The state of one call of move_points(). */
    class GuardedMove
    {
    public:
      GuardedMove(TetMesh &mesh, const std::vector<PointMove> &moves)
        : mesh(mesh), moves(moves), way(moves.size(), 1.), move_of_point(mesh.n_points(), none)
      {
        for (unsigned int i = 0; i < moves.size(); ++i)
          move_of_point[moves[i].point] = i;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int v : mesh.cells[c])
            if (move_of_point[v] != none)
              {
                watch(c);
                break;
              }
        for (const PointMove &move : moves)
          origins.push_back(mesh.points[move.point]);
      }

      MoveReport
      run()
      {
        for (unsigned int i = 0; i < moves.size(); ++i)
          mesh.points[moves[i].point] = moves[i].target;
        for (unsigned int round = 0; true; ++round)
          {
            for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
              {
                const auto poor = cells_below(round == 0 ? wishes : floors);
                if (poor.empty())
                  break;
                if (first.empty())
                  prepare_smoothing();
                smooth(poor);
              }
            const auto bad = cells_below(floors);
            if (bad.empty())
              return report();
            for (const unsigned int c : bad)
              step_back(c, round >= most_rounds);
          }
      }

    private:
      double
      quality(unsigned int cell) const
      {
        const auto &v = mesh.cells[cell];
        return mean_ratio(mesh.points[v[0]],
                          mesh.points[v[1]],
                          mesh.points[v[2]],
                          mesh.points[v[3]]);
      }

      /** Begins to watch a cell, which must be as it was at the beginning. */
      void
      watch(unsigned int cell)
      {
        watched.push_back(cell);
        const double before = quality(cell);
        floors.push_back(std::min(good_enough, 0.5 * before));
        wishes.push_back(std::min(good, 0.9 * before));
      }

      std::vector<unsigned int>
      cells_below(const std::vector<double> &bounds) const
      {
        std::vector<unsigned int> bad;
        for (std::size_t i = 0; i < watched.size(); ++i)
          if (!(quality(watched[i]) >= bounds[i]))
            bad.push_back(watched[i]);
        return bad;
      }

      /** Cells around each point, and which points may be smoothed. */
      void
      prepare_smoothing()
      {
        first.assign(mesh.n_points() + 1, 0);
        for (const auto &cell : mesh.cells)
          for (const unsigned int v : cell)
            ++first[v + 1];
        for (unsigned int p = 0; p < mesh.n_points(); ++p)
          first[p + 1] += first[p];
        around.resize(first.back());
        std::vector<unsigned int> place(first.begin(), first.end() - 1);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int v : mesh.cells[c])
            around[place[v]++] = c;

        is_free.assign(mesh.n_points(), 1);
        for (const auto &face : mesh.faces)
          for (const unsigned int v : face.vertices)
            is_free[v] = 0;
        for (unsigned int p = 0; p < mesh.n_points(); ++p)
          for (unsigned int k = first[p]; k < first[p + 1]; ++k)
            if (mesh.regions[around[k]] != mesh.regions[around[first[p]]])
              is_free[p] = 0;
        smoothed.assign(mesh.n_points(), 0);
        inside = mesh.points;
        is_watched.assign(mesh.n_cells(), 0);
        for (const unsigned int c : watched)
          is_watched[c] = 1;
      }

      void
      watch_around(unsigned int point)
      {
        for (unsigned int k = first[point]; k < first[point + 1]; ++k)
          if (is_watched[around[k]] == 0)
            {
              is_watched[around[k]] = 1;
              watch(around[k]);
            }
      }

      double
      worst_around(unsigned int point) const
      {
        double worst = 1.;
        for (unsigned int k = first[point]; k < first[point + 1]; ++k)
          worst = std::min(worst, quality(around[k]));
        return worst;
      }

      Point<3>
      centre_around(unsigned int point) const
      {
        Point<3> sum;
        double   n = 0.;
        for (unsigned int k = first[point]; k < first[point + 1]; ++k)
          for (const unsigned int v : mesh.cells[around[k]])
            if (v != point)
              {
                sum += mesh.points[v];
                n += 1.;
              }
        return sum / n;
      }

      /** Puts the free points of bad cells where the worst cell around them is best. */
      void
      smooth(const std::vector<unsigned int> &bad)
      {
        for (const unsigned int c : bad)
          for (const unsigned int p : mesh.cells[c])
            {
              if (is_free[p] == 0)
                continue;
              watch_around(p);
              const Point<3>     here   = mesh.points[p];
              const Tensor<1, 3> to_mid = centre_around(p) - here;
              const Tensor<1, 3> away   = away_from_opposite(c, p);
              Point<3>           best   = here;
              double             value  = worst_around(p);
              for (const Tensor<1, 3> &direction : {to_mid, away, -away})
                for (const double part : {1., 0.5, 0.25, 0.125})
                  {
                    mesh.points[p]         = here + part * direction;
                    const double candidate = worst_around(p);
                    if (candidate > value + 1e-3)
                      {
                        value = candidate;
                        best  = mesh.points[p];
                      }
                  }
              mesh.points[p] = best;
              if (best != here)
                smoothed[p] = 1;
            }
      }

      /** Normal of a cell's face opposite a corner towards that corner, half as long as
       * the face is wide. */
      Tensor<1, 3>
      away_from_opposite(unsigned int cell, unsigned int point) const
      {
        std::array<unsigned int, 3> f{};
        unsigned int                n = 0;
        for (const unsigned int v : mesh.cells[cell])
          if (v != point)
            f[n++ % 3] = v;
        const Tensor<1, 3> area = dealii::cross_product_3d(mesh.points[f[1]] - mesh.points[f[0]],
                                                           mesh.points[f[2]] - mesh.points[f[0]]);
        return 0.5 * area / std::sqrt(area.norm());
      }

      /** Halves the ways of a bad cell's points; where there is none left, the points
       * inside go back. Then the cell is as it was. */
      void
      step_back(unsigned int cell, bool all_the_way)
      {
        bool stepped = false;
        for (const unsigned int v : mesh.cells[cell])
          if (const unsigned int i = move_of_point[v]; i != none && way[i] > 0.)
            {
              way[i] = all_the_way || way[i] <= least_way ? 0. : 0.5 * way[i];
              mesh.points[v]
                = way[i] > 0. ? origins[i] + way[i] * (moves[i].target - origins[i]) : origins[i];
              stepped = true;
            }
        if (!stepped || all_the_way)
          for (const unsigned int v : mesh.cells[cell])
            if (is_free[v] != 0)
              {
                mesh.points[v] = inside[v];
                is_free[v]     = 0;
                smoothed[v]    = 0;
              }
      }

      MoveReport
      report() const
      {
        MoveReport result;
        for (std::size_t i = 0; i < moves.size(); ++i)
          {
            ++(way[i] == 1. ? result.n_moved : result.n_held);
            result.farthest
              = std::max(result.farthest, origins[i].distance(mesh.points[moves[i].point]));
          }
        for (const char s : smoothed)
          result.n_smoothed += s;
        // A corner's move sweeps a third of the area times the way.
        for (const auto &face : mesh.faces)
          for (const unsigned int v : face.vertices)
            if (const unsigned int i = move_of_point[v]; i != none)
              result.swept_volume
                += std::abs(face_area_vector(mesh, face) * (mesh.points[v] - origins[i])) / 3.;
        return result;
      }

      static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

      TetMesh                      &mesh;
      const std::vector<PointMove> &moves;
      std::vector<double>           way; ///< part of the way to the target, per move
      std::vector<Point<3>>         origins;
      std::vector<unsigned int>     move_of_point;
      std::vector<unsigned int>     watched; ///< cells
      std::vector<double>           floors;  ///< per watched cell: no worse mean ratio
      std::vector<double>           wishes;  ///< ... and where smoothing begins

      std::vector<unsigned int> first, around; ///< cells around points
      std::vector<char>         is_free, smoothed;
      std::vector<char>         is_watched; ///< per cell
      std::vector<Point<3>>     inside;     ///< where points were before smoothing
    };
  } // namespace

  double
  mean_ratio(const Point<3> &a, const Point<3> &b, const Point<3> &c, const Point<3> &d)
  {
    const Tensor<1, 3> ab = b - a, ac = c - a, ad = d - a;
    const double       six_volumes = dealii::cross_product_3d(ab, ac) * ad;
    const double       squares     = ab.norm_square() + ac.norm_square() + ad.norm_square()
                           + (c - b).norm_square() + (d - b).norm_square() + (d - c).norm_square();
    const double root = std::cbrt(0.5 * six_volumes);
    return std::copysign(12. * root * root / squares, six_volumes);
  }

  MoveReport
  move_points(TetMesh &mesh, const std::vector<PointMove> &moves)
  {
    return moves.empty() ? MoveReport() : GuardedMove(mesh, moves).run();
  }
} // namespace tetradapt::mesh
