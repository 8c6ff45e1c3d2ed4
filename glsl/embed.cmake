# SPDX-License-Identifier: MIT
# Turns shader files into C string literals that still read as shaders, one line of C per line of GLSL.
#   cmake -DOUTPUT=out.h -DNAME=prefix -DSOURCES=a.glsl;b.frag -P embed.cmake
# gives `static const char prefix_a_glsl[] = "..." ...;` for each file.
set(text "/* Made from the shader files by glsl/embed.cmake; edit those. */
/* ISO C promises 4095 characters a literal; compilers take far more. */
#if defined(__GNUC__)
#pragma GCC diagnostic ignored \"-Woverlength-strings\"
#endif
")
foreach(source IN LISTS SOURCES)
  get_filename_component(file ${source} NAME)
  string(MAKE_C_IDENTIFIER "${NAME}_${file}" symbol)
  file(READ ${source} body)
  string(REPLACE "\\" "\\\\" body "${body}")
  string(REPLACE "\"" "\\\"" body "${body}")
  string(REGEX REPLACE "\n$" "" body "${body}")
  string(REPLACE "\n" "\\n\"\n    \"" body "${body}")
  string(APPEND text "\nstatic const char ${symbol}[] =\n    \"${body}\\n\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
