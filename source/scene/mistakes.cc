// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/mistakes.h"

#include <algorithm>
#include <cstdlib>

namespace tetradapt::scene
{
  namespace
  {
    /** More are counted only: a file of another kind has a mistake a line. */
    constexpr std::size_t most_told = 30;

    /** Whether @p inner is @p outer or a part of it. */
    bool
    is_part(const std::string &inner, const std::string &outer)
    {
      return inner.compare(0, outer.size(), outer) == 0
             && (inner.size() == outer.size() || inner[outer.size()] == '/');
    }

    /** Whether @p name is, holds or is part of one of @p names. */
    bool
    concerns(const std::set<std::string> &names, const std::string &name)
    {
      return std::any_of(names.begin(), names.end(), [&](const std::string &other) {
        return is_part(other, name) || is_part(name, other);
      });
    }

    /** The full name that a message begins with: up to a colon, or to the comma of
     * "Loads/tip/Value, component x". */
    std::string
    name_in(const std::string &message)
    {
      const std::string name = message.substr(0, message.find(": "));
      return name.substr(0, name.find(", "));
    }

    /** The line in "file:line: ..."; 0 if @p message does not begin so. */
    unsigned long
    line_in(const std::string &message, const std::string &file)
    {
      return message.compare(0, file.size() + 1, file + ":") == 0
               ? std::strtoul(message.c_str() + file.size() + 1, nullptr, 10)
               : 0;
    }
  } // namespace

  SeveralMistakes::SeveralMistakes(const std::vector<std::string> &messages)
    : core::InputError(messages.front() + " (and " + std::to_string(messages.size() - 1)
                       + " more)"),
      messages(messages)
  {
  }

  void
  Mistakes::add(const std::string &name, const std::string &text)
  {
    add_message(name + ": " + text, name);
  }

  bool
  Mistakes::require(const bool condition, const std::string &name, const std::string &text)
  {
    if (!condition)
      add(name, text);
    return condition;
  }

  void
  Mistakes::add_message(const std::string &message, const std::string &name, const bool readable)
  {
    if (std::find(messages.begin(), messages.end(), message) == messages.end())
      messages.push_back(message);
    if (!name.empty())
      unsound.insert(name);
    if (!readable)
      mark_unreadable(name);
  }

  void
  Mistakes::mark_unreadable(const std::string &name)
  {
    if (!name.empty())
      {
        unsound.insert(name);
        unreadable.insert(name);
      }
  }

  void
  Mistakes::give_up()
  {
    given_up = true;
  }

  bool
  Mistakes::attempt(const std::function<void()> &action)
  {
    return attempt(action, true);
  }

  bool
  Mistakes::attempt_reading(const std::function<void()> &action)
  {
    return attempt(action, false);
  }

  bool
  Mistakes::attempt(const std::function<void()> &action, const bool stays_readable)
  {
    try
      {
        action();
        return true;
      }
    catch (const SeveralMistakes &several)
      {
        for (const std::string &message : several.messages)
          add_message(message, name_in(message), stays_readable);
        return false;
      }
    catch (const core::InputError &error)
      {
        add_message(error.what(), name_in(error.what()), stays_readable);
        return false;
      }
  }

  bool
  Mistakes::readable(const std::string &name) const
  {
    return !given_up && !concerns(unreadable, name);
  }

  bool
  Mistakes::sound(const std::initializer_list<std::string> names) const
  {
    return !given_up && std::none_of(names.begin(), names.end(), [&](const std::string &name) {
      return concerns(unsound, name);
    });
  }

  Mistakes
  Mistakes::marks() const
  {
    Mistakes copy = *this;
    copy.messages.clear();
    return copy;
  }

  void
  Mistakes::merge(const Mistakes &other)
  {
    for (const std::string &message : other.messages)
      add_message(message, "");
    unsound.insert(other.unsound.begin(), other.unsound.end());
    unreadable.insert(other.unreadable.begin(), other.unreadable.end());
    given_up = given_up || other.given_up;
  }

  void
  Mistakes::merge(const Mistakes                                        &other,
                  const std::function<std::string(const std::string &)> &edit)
  {
    Mistakes edited = other;
    for (std::string &message : edited.messages)
      message = edit(message);
    merge(edited);
  }

  void
  Mistakes::throw_together() const
  {
    if (messages.size() == 1)
      throw core::InputError(messages[0]);
    if (!messages.empty())
      throw SeveralMistakes(messages);
  }

  void
  Mistakes::throw_if_any(const std::string &file) const
  {
    if (messages.empty())
      return;
    if (messages.size() == 1)
      throw core::InputError(messages[0]);
    std::vector<std::string> sorted = messages;
    std::stable_sort(sorted.begin(), sorted.end(), [&](const auto &a, const auto &b) {
      // Those without a line come last.
      return line_in(a, file) - 1 < line_in(b, file) - 1;
    });
    std::string text = file + " has " + std::to_string(sorted.size()) + " mistakes:";
    for (std::size_t i = 0; i < std::min(sorted.size(), most_told); ++i)
      text += "\n  " + sorted[i];
    if (sorted.size() > most_told)
      text += "\n  and " + std::to_string(sorted.size() - most_told) + " more.";
    throw core::InputError(text);
  }
} // namespace tetradapt::scene
