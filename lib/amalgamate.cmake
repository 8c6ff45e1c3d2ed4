# SPDX-License-Identifier: MIT
# Makes glssao.c and glssao.h, which need no build system, from the library's sources and shaders.
#   cmake -DOUTPUT=folder -DSOURCES=a.c;b.c -DINCLUDES=folder;folder -DHEADER=glssao.h -DLICENSE=file -P amalgamate.cmake
# Included files are put in place of their #include, each once; file-scope names that two sources share get the
# source's name in front by a macro that ends with that source.

cmake_minimum_required(VERSION 3.22)
set(included "")

# What stands in `text`, with the first `what` replaced.
function(replace_first text what by out)
  string(FIND "${text}" "${what}" start)
  string(LENGTH "${what}" length)
  math(EXPR end "${start} + ${length}")
  string(SUBSTRING "${text}" 0 ${start} before)
  string(SUBSTRING "${text}" ${end} -1 after)
  set(${out} "${before}${by}${after}" PARENT_SCOPE)
endfunction()

function(find_included name out)
  foreach(folder IN LISTS INCLUDES)
    if(EXISTS ${folder}/${name})
      set(${out} ${folder}/${name} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "amalgamate: ${name} is in none of ${INCLUDES}")
endfunction()

macro(expand text_name)
  while(${text_name} MATCHES "#include \"([^\"]+)\"\n")
    set(directive "${CMAKE_MATCH_0}")
    set(name "${CMAKE_MATCH_1}")
    set(body "")
    if(name MATCHES "(^|/)glssao\\.h$")
      # The public header stays a file of its own, included once at the top.
    elseif(NOT name IN_LIST included)
      find_included(${name} path)
      file(READ ${path} body)
      list(APPEND included ${name})
    endif()
    replace_first("${${text_name}}" "${directive}" "${body}" ${text_name})
  endwhile()
endmacro()

# File-scope names of a source: static functions and objects, tags, and objects declared together with their struct.
function(file_scope_names text out)
  set(names "")
  string(REGEX MATCHALL "\n(static|typedef struct|typedef enum|struct|enum) [A-Za-z_0-9 *]+" declarations "${text}")
  string(REGEX MATCHALL "\n} [A-Za-z_0-9]+" objects "${text}")
  foreach(declaration IN LISTS declarations objects)
    string(STRIP "${declaration}" declaration)
    string(REGEX MATCH "[A-Za-z_0-9]+$" name "${declaration}")
    list(APPEND names ${name})
  endforeach()
  list(REMOVE_DUPLICATES names)
  set(${out} ${names} PARENT_SCOPE)
endfunction()

set(all_names "")
foreach(source IN LISTS SOURCES)
  file(READ ${source} text)
  file_scope_names("\n${text}" names_${source})
  list(APPEND all_names ${names_${source}})
endforeach()

set(code "")
foreach(source IN LISTS SOURCES)
  get_filename_component(stem ${source} NAME_WE)
  file(READ ${source} text)
  set(before "")
  set(after "")
  foreach(name IN LISTS names_${source})
    set(others ${all_names})
    list(FILTER others INCLUDE REGEX "^${name}$")
    list(LENGTH others count)
    if(count GREATER 1)
      string(APPEND before "#define ${name} glssao__${stem}_${name}\n")
      string(APPEND after "#undef ${name}\n")
    endif()
  endforeach()
  string(APPEND code "\n/* ---- ${stem}.c ---- */\n\n${before}${text}${after}")
endforeach()
expand(code)

# System headers first, so that no macro above reaches them; one that not every system has is followed by a comment and stays.
string(REGEX MATCHALL "#include <[^>]+>\n" system_includes "${code}")
list(REMOVE_DUPLICATES system_includes)
list(SORT system_includes)
string(REPLACE ";" "" system_includes "${system_includes}")
string(REGEX REPLACE "#include <[^>]+>\n" "" code "${code}")

file(READ ${LICENSE} license)
file(READ ${HEADER} header)
file(WRITE ${OUTPUT}/glssao.h "${header}")
file(WRITE ${OUTPUT}/glssao.c "/* SPDX-License-Identifier: MIT
 *
 * glssao in one file, made by the target glssao-amalgamation; edit the sources, not this. Compile it as C11 and link
 * with the maths library (-lm) where there is one.
 *
${license}*/
#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L
#endif
#ifndef GLSSAO_BUILD
#define GLSSAO_BUILD
#endif
#ifndef GLSSAO_CHECK_GL
#define GLSSAO_CHECK_GL 0
#endif
#include \"glssao.h\"

${system_includes}
${code}")
