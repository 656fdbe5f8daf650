// SPDX-License-Identifier: AGPL-3.0-or-later
#include "require.h"

#include "values.h"

#include "tetradapt/core/expression.h"
#include "tetradapt/core/expression_tokens.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

namespace tetradapt::scene
{
  namespace
  {
    bool
    names_time(const std::string &text)
    {
      const auto tokens = core::expression_tokens(text);
      return std::any_of(tokens.begin(), tokens.end(), [](const core::ExpressionToken &token) {
        return token.is("t");
      });
    }
  } // namespace

  void
  require_no_time(const std::string &text, const std::string &what)
  {
    require(!names_time(text),
            what,
            "'" + text
              + "' depends on the time t, but the scene is static. Write a number in the place of "
                "t.");
  }

  bool
  constant_value(const std::string &text, const std::string &what, double &value)
  {
    const core::Expression expression(text, what);
    require_no_time(text, what);
    if (!expression.is_constant())
      return false;
    value = expression(core::Point<3>());
    return true;
  }

  void
  check_expression(const std::string &text, const std::string &what)
  {
    double value;
    constant_value(text, what, value);
  }

  void
  check_size(const std::string &text, const std::string &path)
  {
    if (text.empty())
      return;
    double value;
    require(!constant_value(text, path, value) || value > 0.,
            path,
            "an edge length of " + text + " is not possible: it must be positive.");
  }

  namespace
  {
    /** What to do about a missing file, if that is known. */
    std::string
    cure_for(const std::string &file)
    {
      if (file.find(".cache/data/femur.off") != std::string::npos)
        return "This surface comes with Debian's package libcgal-demo: start the scene with "
               "./run, which takes it from there, or extract data/meshes/femur.off from that "
               "package's data.tar.gz to this place yourself.";
      return "Correct the name; a relative one counts from the folder of the file that it "
             "is written in.";
    }

    std::string
    ending_of(const std::string &file)
    {
      std::string ending = std::filesystem::path(file).extension().string();
      std::transform(ending.begin(), ending.end(), ending.begin(), [](const unsigned char c) {
        return std::tolower(c);
      });
      return ending;
    }

    void
    check_readable(const std::string &file, const std::string &path)
    {
      std::error_code error;
      require(std::filesystem::exists(file, error) && !error,
              path,
              "there is no file '" + file + "'. " + cure_for(file));
      require(std::filesystem::is_regular_file(file, error) && !error,
              path,
              "'" + file + "' is a folder or a device, not a file.");
      std::ifstream stream(file, std::ios::binary);
      require(stream.peek() != std::ifstream::traits_type::eof(),
              path,
              "the file '" + file
                + "' is empty or cannot be read. Check its content and permissions.");
    }
  } // namespace

  void
  check_file(const std::string              &file,
             const std::string              &path,
             const std::vector<std::string> &endings)
  {
    const std::string ending = ending_of(file);
    std::string       list;
    for (const auto &valid : endings)
      list += (list.empty() ? "" : ", ") + valid;
    require(std::find(endings.begin(), endings.end(), ending) != endings.end(),
            path,
            "files that end in '" + ending + "' cannot be read here ('" + file
              + "'). Known endings: " + list + ".");
    check_readable(file, path);
    // A TetGen mesh is a pair of files that share their stem.
    if (ending == ".node" || ending == ".ele")
      check_readable(std::filesystem::path(file)
                       .replace_extension(ending == ".node" ? ".ele" : ".node")
                       .string(),
                     path);
  }

  void
  check_quality(const double       radius_edge_ratio,
                const double       dihedral_angle,
                const std::string &section)
  {
    require(radius_edge_ratio >= 1.1,
            section + "/Radius-edge ratio",
            "TetGen never finishes with a bound of " + text_of(radius_edge_ratio)
              + ": it must be at least 1.1, and 1.2 (strict) to 2 (loose) is usual.");
    require(dihedral_angle >= 0. && dihedral_angle <= 20.,
            section + "/Minimum dihedral angle",
            "TetGen cannot obtain " + text_of(dihedral_angle)
              + " degrees: choose 0 (no bound) to 20; up to 18 is usual.");
  }
} // namespace tetradapt::scene
