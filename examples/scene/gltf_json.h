// SPDX-License-Identifier: MIT
//
// Reads members of JSON objects and checks their types. A wrong type throws a gltf_json_error whose text names the
// object and the member. C++ only.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

using json = nlohmann::json;

struct gltf_json_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// An object of the file, with its name for messages, such as "node 5".
class gltf_object
{
  public:
    gltf_object(const json &value, std::string name) : value_(value), name_(std::move(name))
    {
        if (!value.is_object())
            throw gltf_json_error(name_ + " is not an object");
    }

    [[noreturn]] void fail(const std::string &fault) const
    {
        throw gltf_json_error(name_ + ": " + fault);
    }

    // NULL where it is missing.
    const json *find(const char *member) const
    {
        const auto found = value_.find(member);
        return found == value_.end() ? nullptr : &*found;
    }

    double number(const char *member, double missing) const
    {
        const json *found = find(member);
        if (found && !found->is_number())
            fail(std::string(member) + " is not a number");
        return found ? found->get<double>() : missing;
    }

    bool flag(const char *member) const
    {
        const json *found = find(member);
        if (found && !found->is_boolean())
            fail(std::string(member) + " is neither true nor false");
        return found && found->get<bool>();
    }

    std::string text(const char *member, const char *missing) const
    {
        const json *found = find(member);
        if (found && !found->is_string())
            fail(std::string(member) + " is not text");
        return found ? found->get<std::string>() : missing;
    }

    // An index, -1 if it is missing. Other negative values are kept: gltf_check() names them in its message.
    int index(const char *member) const
    {
        const double value = number(member, -1);
        if (value != std::floor(value) || std::fabs(value) > std::numeric_limits<int>::max())
            fail(std::string(member) + " is not an index");
        return static_cast<int>(value);
    }

    // A byte offset, a length or a count.
    size_t size(const char *member, size_t missing) const
    {
        const json *found = find(member);
        if (!found)
            return missing;
        if (found->is_number_unsigned())
            return found->get<size_t>();
        const double value = number(member, 0);
        if (value < 0)
            fail(std::string(readable(member)) + " is negative");
        if (value != std::floor(value) || value > 9e15)
            fail(std::string(readable(member)) + " is not a whole number");
        return static_cast<size_t>(value);
    }

    // Fills `out` where the member is there; it has to have as many numbers.
    template <size_t N> void numbers(const char *member, double (&out)[N]) const
    {
        const json *found = find(member);
        if (!found)
            return;
        if (!found->is_array() || found->size() != N)
            fail("its " + std::string(member) + " does not have " + std::to_string(N) + " numbers");
        for (size_t i = 0; i < N; ++i) {
            if (!(*found)[i].is_number())
                fail("its " + std::string(member) + " does not have " + std::to_string(N) + " numbers");
            out[i] = (*found)[i].get<double>();
        }
    }

    // Empty where it is missing.
    const json &list(const char *member) const
    {
        static const json empty = json::array();
        const json *found = find(member);
        if (found && !found->is_array())
            fail(std::string(member) + " is not a list");
        return found ? *found : empty;
    }

    gltf_object object(const char *member) const
    {
        static const json empty = json::object();
        const json *found = find(member);
        return {found ? *found : empty, name_};
    }

    // Of this object; empty where it does not use the extension.
    gltf_object extension(const char *extension) const
    {
        return object("extensions").object(extension);
    }

    bool uses(const char *extension) const
    {
        return object("extensions").find(extension) != nullptr;
    }

    const std::string &name() const
    {
        return name_;
    }

    const json &value() const
    {
        return value_;
    }

  private:
    static const char *readable(const char *member)
    {
        return std::string(member) == "byteOffset" ? "byte offset" : member;
    }

    const json &value_;
    std::string name_;
};
