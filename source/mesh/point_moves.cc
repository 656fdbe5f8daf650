// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/point_moves.h"

#include "local_smoothing.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_intersections.h"
#include "tetradapt/mesh/kept_places.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr double       good_enough   = 0.2;  ///< mean ratio that a cell may always have
    constexpr double       least_cosine  = 0.5;  ///< of the angle by which a face may turn
    constexpr double       least_way     = 0.1;  ///< part of a way below which a point stays
    constexpr double       far_away      = 0.15; ///< by an edge: ways that take points along
    constexpr unsigned int n_layers      = 5;    ///< of cells around such ways
    constexpr unsigned int n_relaxations = 15;
    constexpr unsigned int n_sweeps      = 4; ///< of smoothing, before ways are halved
    constexpr unsigned int most_rounds   = 12;

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
        for (const KeptPlace &place : mesh.kept)
          for (const unsigned int v : vertices_of(mesh, place))
            kept.push_back(v);
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          for (const unsigned int v : mesh.faces[f].vertices)
            if (move_of_point[v] != none)
              {
                const Tensor<1, 3> area = face_area_vector(mesh, mesh.faces[f]);
                faces.push_back(f);
                normals.push_back(area / area.norm());
                break;
              }
      }

      MoveReport
      run()
      {
        for (unsigned int i = 0; i < moves.size(); ++i)
          mesh.points[moves[i].point] = moves[i].target;
        settle_boundary();
        take_along();
        for (unsigned int round = 0; true; ++round)
          {
            for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
              {
                const auto poor = cells_below(round == 0 ? wishes : floors);
                if (poor.empty())
                  break;
                prepare_smoothing();
                smooth(poor);
              }
            const auto bad       = cells_below(floors);
            const auto bad_faces = turned_faces();
            if (bad.empty() && bad_faces.empty() && !part_crossing_faces(round >= most_rounds))
              return report();
            for (const unsigned int c : bad)
              step_back(mesh.cells[c], round >= most_rounds);
            for (const unsigned int f : bad_faces)
              step_back(mesh.faces[f].vertices, round >= most_rounds);
          }
      }

    private:
      /** Begins to watch a cell, which must be as it was at the beginning. */
      void
      watch(unsigned int cell)
      {
        watched.push_back(cell);
        const double before = mean_ratio(mesh, cell);
        floors.push_back(std::min(good_enough, 0.5 * before));
        wishes.push_back(std::min(good_mean_ratio, 0.9 * before));
      }

      std::vector<unsigned int>
      cells_below(const std::vector<double> &bounds) const
      {
        std::vector<unsigned int> bad;
        for (std::size_t i = 0; i < watched.size(); ++i)
          if (!(mean_ratio(mesh, watched[i]) >= bounds[i]))
            bad.push_back(watched[i]);
        return bad;
      }

      /** Faces that turned too far: cells that are all positive may overlap where the
       * boundary folds. */
      std::vector<unsigned int>
      turned_faces() const
      {
        std::vector<unsigned int> turned;
        for (std::size_t i = 0; i < faces.size(); ++i)
          {
            const Tensor<1, 3> area = face_area_vector(mesh, mesh.faces[faces[i]]);
            if (!(area * normals[i] >= least_cosine * area.norm()))
              turned.push_back(faces[i]);
          }
        return turned;
      }

      /** Steps back where boundary faces cross; whether there were any that could.
       * Cells can all be positive and yet overlap, next to a fold of the boundary. */
      bool
      part_crossing_faces(bool all_the_way)
      {
        if (!goes_far)
          return false;
        geometry::SurfaceMesh surface;
        surface.points = mesh.points;
        for (const auto &face : mesh.faces)
          surface.triangles.push_back(face.vertices);
        std::vector<std::pair<unsigned int, unsigned int>> pairs;
        try
          {
            pairs = geometry::self_intersections(surface);
          }
        catch (const core::InputError &)
          {
            return false; // no manifold: nothing is known
          }
        bool parted = false;
        for (const auto &[f, g] : pairs)
          for (const unsigned int face : {f, g})
            parted = step_back(mesh.faces[face].vertices, all_the_way) || parted;
        return parted;
      }

      /** Steps back where no smoothing can help: faces that turned, and bad cells without a
       * corner inside. */
      void
      settle_boundary()
      {
        for (unsigned int round = 0; true; ++round)
          {
            const auto bad       = cells_below(floors);
            const auto bad_faces = turned_faces();
            bool       settled   = true;
            if (!bad.empty())
              prepare_smoothing();
            for (const unsigned int c : bad)
              if (std::none_of(mesh.cells[c].begin(), mesh.cells[c].end(), [&](unsigned int v) {
                    return smoothing->is_free(v);
                  }))
                {
                  step_back(mesh.cells[c], round >= most_rounds);
                  settled = false;
                }
            for (const unsigned int f : bad_faces)
              {
                step_back(mesh.faces[f].vertices, round >= most_rounds);
                settled = false;
              }
            if (settled)
              return;
          }
      }

      void
      prepare_smoothing()
      {
        if (smoothing != nullptr)
          return;
        smoothing = std::make_unique<LocalSmoothing>(mesh);
        for (const unsigned int v : kept)
          smoothing->fix(v);
        inside = mesh.points;
        smoothed.assign(mesh.n_points(), 0);
        is_watched.assign(mesh.n_cells(), 0);
        for (const unsigned int c : watched)
          is_watched[c] = 1;
      }

      /** Moves the points inside near those that go far, each by the mean of the ways around
       * it: where a way is as long as a cell, smoothing one point at a time is not
       * enough. */
      void
      take_along()
      {
        std::vector<unsigned int> far;
        std::vector<char>         is_far(moves.size(), 0);
        for (const unsigned int c : watched)
          for (const unsigned int v : mesh.cells[c])
            if (const unsigned int i = move_of_point[v]; i != none && is_far[i] == 0)
              for (const unsigned int w : mesh.cells[c])
                if (w != v
                    && mesh.points[v].distance(origins[i])
                         > far_away * origins[i].distance(mesh.points[w]))
                  is_far[i] = 1;
        for (unsigned int i = 0; i < moves.size(); ++i)
          if (is_far[i] != 0)
            far.push_back(moves[i].point);
        goes_far = !far.empty();
        if (!goes_far)
          return;
        prepare_smoothing();

        const std::vector<unsigned int> near = smoothing->free_points_near(far, n_layers);
        std::vector<Tensor<1, 3>>       ways(mesh.n_points());
        for (unsigned int i = 0; i < moves.size(); ++i)
          ways[moves[i].point] = mesh.points[moves[i].point] - origins[i];
        for (unsigned int sweep = 0; sweep < n_relaxations; ++sweep)
          for (const unsigned int p : near)
            {
              const auto [first, end] = smoothing->cells_around(p);
              Tensor<1, 3> sum;
              for (const unsigned int *cell = first; cell != end; ++cell)
                for (const unsigned int v : mesh.cells[*cell])
                  if (v != p)
                    sum += ways[v];
              ways[p] = sum / (3. * (end - first));
            }
        for (const unsigned int p : near)
          watch_around(p);
        for (const unsigned int p : near)
          {
            mesh.points[p] += ways[p];
            smoothed[p] = 1;
          }
      }

      void
      watch_around(unsigned int point)
      {
        const auto [first, end] = smoothing->cells_around(point);
        for (const unsigned int *cell = first; cell != end; ++cell)
          if (is_watched[*cell] == 0)
            {
              is_watched[*cell] = 1;
              watch(*cell);
            }
      }

      void
      smooth(const std::vector<unsigned int> &poor)
      {
        for (const unsigned int c : poor)
          for (const unsigned int p : mesh.cells[c])
            if (smoothing->is_free(p))
              {
                watch_around(p);
                if (smoothing->improve(c, p))
                  smoothed[p] = 1;
              }
      }

      /** Halves the ways of the corners of a bad cell or face; where there is none left, the points
       * inside go back. Then the cell is as it was. */
      template <std::size_t n>
      bool
      step_back(const std::array<unsigned int, n> &corners, bool all_the_way)
      {
        bool stepped = false;
        for (const unsigned int v : corners)
          if (const unsigned int i = move_of_point[v]; i != none && way[i] > 0.)
            {
              way[i] = all_the_way || way[i] <= least_way ? 0. : 0.5 * way[i];
              mesh.points[v]
                = way[i] > 0. ? origins[i] + way[i] * (moves[i].target - origins[i]) : origins[i];
              stepped = true;
            }
        if (smoothing != nullptr && (!stepped || all_the_way))
          for (const unsigned int v : corners)
            if (smoothing->is_free(v))
              {
                mesh.points[v] = inside[v];
                smoothed[v]    = 0;
                smoothing->fix(v);
              }
        return stepped;
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
      bool                          goes_far = false; ///< compared with the cells' edges
      std::vector<double>           way;              ///< part of the way to the target, per move
      std::vector<Point<3>>         origins;
      std::vector<unsigned int>     move_of_point;
      std::vector<unsigned int>     kept;    ///< points that no smoothing moves
      std::vector<unsigned int>     faces;   ///< with points that move
      std::vector<Tensor<1, 3>>     normals; ///< of these faces, at the beginning
      std::vector<unsigned int>     watched; ///< cells
      std::vector<double>           floors;  ///< per watched cell: no worse mean ratio
      std::vector<double>           wishes;  ///< ... and where smoothing begins

      /** Made when it is needed, together with what follows. */
      std::unique_ptr<LocalSmoothing> smoothing;
      std::vector<Point<3>>           inside;     ///< where points were before
      std::vector<char>               smoothed;   ///< points
      std::vector<char>               is_watched; ///< per cell
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
