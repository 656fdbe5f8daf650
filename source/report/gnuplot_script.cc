// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/gnuplot.h"
#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::report
{
  namespace
  {
    /** M. Okabe and K. Ito's colours, which colour-blind eyes tell apart, but with grey
     * for their yellow, which white paper hides. */
    const std::array<const char *, n_plot_colours> colours{
      {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#909090"}};
    /** Lines: solid, dashes, dots, dashes and dots. */
    const std::array<const char *, 4> dashes{{"1", "(10,5)", "(2,4)", "(10,4,2,4)"}};
    /** Points: full circle, square, triangle, lozenge; then the same hollow. */
    const std::array<unsigned int, 8> points{{7, 5, 9, 13, 6, 4, 8, 12}};

    std::string
    number(const double value)
    {
      return format_number(value, 8);
    }

    struct Range
    {
      double lower = 1e300, upper = -1e300;

      void
      add(const double value)
      {
        lower = std::min(lower, value);
        upper = std::max(upper, value);
      }
      bool
      empty() const
      {
        return lower > upper;
      }
    };

    /** The value as a label: 0.02, 3000, 2 10^6. */
    std::string
    tick_label(const double mantissa, const int exponent)
    {
      if (exponent >= -3 && exponent < 4)
        return format_number(mantissa * std::pow(10., exponent), 6);
      return (mantissa == 1. ? "" : format_number(mantissa, 2) + "·") + "10^{"
             + std::to_string(exponent) + "}";
    }

    /** Ticks of a logarithmic axis: gnuplot would put one on each power of ten only. */
    std::string
    logarithmic_axis(const std::string &axis, const Range &range)
    {
      const double        decades = std::log10(range.upper / range.lower);
      std::vector<double> mantissas{1.};
      if (decades < 1.)
        mantissas = {1., 1.5, 2., 3., 4., 5., 6., 8.};
      else if (decades < 2.5)
        mantissas = {1., 2., 5.};
      const int   stride = decades > 12. ? std::ceil(decades / 12.) : 1;
      std::string ticks;
      const int   first = std::floor(std::log10(range.lower)),
                last    = std::ceil(std::log10(range.upper));
      for (int exponent = first; exponent <= last; exponent += stride)
        for (const double mantissa : mantissas)
          ticks += (ticks.empty() ? "" : ", ") + ("'" + tick_label(mantissa, exponent)) + "' "
                   + number(mantissa * std::pow(10., exponent));
      return "set logscale " + axis + "\nset " + axis + "tics (" + ticks + ")\n";
    }

    std::string
    range_line(const std::string &axis, const Range &range)
    {
      return "set " + axis + "range [" + number(range.lower) + ":" + number(range.upper) + "]\n";
    }

    /** What all pictures have in common; @p n_names are explained next to them. */
    std::string
    begin_script(const std::string &title,
                 const std::string &x_label,
                 const std::string &y_label,
                 const std::size_t  n_names)
    {
      // Each name takes 23 points; the title, ticks and the label of the axis the rest.
      const std::size_t height = std::max<std::size_t>(540, 170 + 23 * n_names);
      return "# gnuplot -d this.gp > this.svg\n"
             "set terminal svg size 900,"
             + std::to_string(height)
             + " font 'Arial,15' background '#ffffff' enhanced rounded\n"
               "set encoding utf8\n"
               "set title "
             + gnuplot_text(title)
             + " noenhanced\n"
               "set border 3 lc rgb '#606060'\n"
               "set tics nomirror textcolor rgb '#202020'\n"
               "set grid lc rgb '#e0e0e0' lt 1 lw 1\n"
               "set key outside right top vertical maxcols 1 Left reverse samplen 4.5 noenhanced\n"
               "set xlabel "
             + gnuplot_text(x_label) + " enhanced\nset ylabel " + gnuplot_text(y_label)
             + " enhanced\n";
    }

    bool
    can_be_shown(const std::array<double, 2> &point, const LinePlot &plot)
    {
      return std::isfinite(point[0]) && std::isfinite(point[1])
             && (!plot.logarithmic_x || point[0] > 0.) && (!plot.logarithmic_y || point[1] > 0.);
    }

    /** The curve with the points that can be shown. */
    PlotCurve
    shown(const PlotCurve &curve, const LinePlot &plot)
    {
      PlotCurve result = curve;
      result.points.clear();
      std::copy_if(curve.points.begin(),
                   curve.points.end(),
                   std::back_inserter(result.points),
                   [&](const std::array<double, 2> &point) { return can_be_shown(point, plot); });
      return result;
    }

    void
    widen(Range &range, const bool logarithmic, const double part)
    {
      if (logarithmic)
        {
          const double factor = std::max(1.1, std::pow(range.upper / range.lower, part));
          range.lower /= factor;
          range.upper *= factor;
        }
      else
        {
          const double width = range.upper - range.lower;
          const double more  = width > 0. ? part * width : std::max(0.5, 0.1 * std::abs(width));
          range.lower -= more;
          range.upper += more;
        }
    }

    /** Triangles side by side below the left part of the curves, which fall to the right, so
     * that nothing is there; @p y grows downwards to hold them. Returns the data block and the
     * labels. */
    std::string
    slope_triangles(const std::vector<PlotSlope> &slopes, const Range &x, Range &y)
    {
      const double width = std::max(1.4, std::pow(x.upper / x.lower, 0.11));
      double       left  = x.lower * std::pow(x.upper / x.lower, 0.03);
      double       high  = 1.;
      for (const PlotSlope &slope : slopes)
        high = std::max(high, std::pow(width, -slope.exponent));
      const double bottom = y.lower / std::pow(y.upper / y.lower, 0.02);
      y.lower             = bottom / std::max(1.1, std::pow(y.upper / y.lower, 0.04));
      std::string data    = "$slopes << EOD\n", labels;
      for (const PlotSlope &slope : slopes)
        {
          const double top = bottom * std::pow(width, -slope.exponent);
          data += number(left) + " " + number(top) + "\n" + number(left) + " " + number(bottom)
                  + "\n" + number(left * width) + " " + number(bottom) + "\n" + number(left) + " "
                  + number(top) + "\n\n";
          labels += "set label " + gnuplot_text(slope.label) + " at "
                    + number(left * std::sqrt(width)) + "," + number(std::sqrt(top * bottom))
                    + " left offset 0.5,0.5 textcolor rgb '#606060' font ',13'\n";
          // The label begins in the middle of its triangle.
          left *= std::sqrt(width) * std::pow(x.upper / x.lower, 0.16);
        }
      return data + "EOD\n" + labels;
    }

    std::string
    curve_command(const PlotCurve &curve, const std::string &block)
    {
      const std::string colour = colours[curve.colour % colours.size()];
      std::string       style  = "with linespoints pt "
                          + std::to_string(points[curve.pattern % points.size()]) + " ps 0.75";
      if (curve.steps)
        style = "with histeps";
      return block + " " + style + " lw 2 lc rgb '" + colour + "' dt "
             + dashes[curve.pattern % dashes.size()] + " title " + gnuplot_text(curve.label);
    }
  } // namespace

  std::string
  gnuplot_text(const std::string &text)
  {
    // Not between apostrophes: gnuplot 5.4 takes two of them in a row for the end.
    std::string quoted = "\"";
    for (const char c : text)
      if (c == '"' || c == '\\')
        quoted += std::string("\\") + c;
      else if (c == '`') // what stands between two is run as a command
        quoted += "\\140";
      else
        quoted += static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
    return quoted + "\"";
  }

  std::string
  gnuplot_script(const LinePlot &plot)
  {
    std::vector<PlotCurve> curves;
    Range                  x, y;
    for (const PlotCurve &curve : plot.curves)
      {
        curves.push_back(shown(curve, plot));
        for (const auto &point : curves.back().points)
          {
            x.add(point[0]);
            y.add(point[1]);
          }
        if (curves.back().points.empty())
          curves.pop_back();
      }
    if (x.empty())
      return "";
    if (plot.level)
      y.add(*plot.level);
    widen(x, plot.logarithmic_x, 0.04);
    widen(y, plot.logarithmic_y, 0.05);

    std::string script      = begin_script(plot.title, plot.x_label, plot.y_label, curves.size());
    const bool  with_slopes = plot.logarithmic_x && plot.logarithmic_y && !plot.slopes.empty();
    if (with_slopes)
      script += slope_triangles(plot.slopes, x, y);
    script += range_line("x", x) + range_line("y", y);
    if (plot.logarithmic_x)
      script += logarithmic_axis("x", x);
    if (plot.logarithmic_y)
      script += logarithmic_axis("y", y);
    if (plot.whole_x)
      script += "set xtics " + number(std::ceil((x.upper - x.lower) / 15.)) + "\n";
    if (!plot.key.empty())
      script += "set key title " + gnuplot_text(plot.key) + " left noenhanced\n";
    if (!plot.explanation.empty())
      script += "set label " + gnuplot_text(plot.explanation)
                + " at screen 0.99,0.025 right textcolor rgb '#606060' font ',12'\n";
    std::string commands;
    for (std::size_t i = 0; i < curves.size(); ++i)
      {
        const std::string block = "$curve" + std::to_string(i);
        script += block + " << EOD\n";
        for (const auto &point : curves[i].points)
          script += number(point[0]) + " " + number(point[1]) + "\n";
        script += "EOD\n";
        commands += (i == 0 ? "" : ", \\\n     ") + curve_command(curves[i], block);
      }
    if (plot.level)
      commands
        += ", \\\n     " + number(*plot.level) + " with lines lw 1.5 lc rgb '#909090' notitle";
    if (with_slopes)
      commands += ", \\\n     $slopes with lines lw 1.5 lc rgb '#909090' notitle";
    return script + "plot " + commands + "\n";
  }

  std::string
  gnuplot_script(const BarPlot &plot)
  {
    if (plot.series.empty() || plot.classes.empty())
      return "";
    std::string script
      = begin_script(plot.title, plot.x_label, plot.y_label, plot.series.size())
        + "set style data histograms\nset style histogram clustered gap 1\n"
          "set style fill solid 0.9 noborder\nset yrange [0:*]\nset xtics scale 0\n"
          "$bars << EOD\n";
    for (std::size_t i = 0; i < plot.classes.size(); ++i)
      {
        // Names of classes are the program's own words, without blanks.
        script += plot.classes[i];
        for (const BarPlot::Series &series : plot.series)
          script += " " + number(series.values.at(i));
        script += "\n";
      }
    script += "EOD\nplot ";
    for (std::size_t i = 0; i < plot.series.size(); ++i)
      script += (i == 0 ? "" : ", \\\n     ") + std::string("$bars using ") + std::to_string(i + 2)
                + ":xtic(1) lc rgb '" + colours[i % colours.size()] + "' title "
                + gnuplot_text(plot.series[i].label);
    return script + "\n";
  }
} // namespace tetradapt::report
