# Every header compiles after the headers of windows, X11, curses, game engines and others, whose macros have common words for names. What it includes itself comes
# before them: the standard library and Eigen hold fewer.
set(windows_macros "min(a,b)" "max(a,b)" small hyper near far pascal cdecl interface uuid environ IN OUT OPTIONAL NEAR FAR PASCAL CDECL CONST VOID THIS PURE
  STRICT TRUE FALSE BOOL ERROR NOERROR NO_ERROR DELETE IGNORE INFINITE ABSOLUTE RELATIVE DIFFERENCE ALTERNATE WINDING OPAQUE TRANSPARENT PLANES TECHNOLOGY
  REGISTERED SYNCHRONIZE DUPLICATE PASSTHROUGH DECREF INCREF INTERFACE CALLBACK TEXT RGB CMYK HALFTONE "FAILED(x)" "SUCCEEDED(x)" DOMAIN SING OVERFLOW UNDERFLOW
  GetObject GetMessage SendMessage PostMessage CreateWindow CreateFile CopyFile MoveFile DeleteFile GetClassName GetClassInfo RegisterClass DrawText LoadImage
  PlaySound ReportEvent StartDoc UpdateResource GetCurrentTime Yield edt1 lst1 grp1 rad1 ctl1 scr1)
set(x11_macros Status Bool True False None Success Always Never Above Below Complex Convex Nonconvex Opposite Unsorted Expose Button1 ControlMask ShiftMask LockMask
  FocusIn FocusOut KeyPress KeyRelease MotionNotify MapNotify CurrentTime CursorShape AnyKey AllPlanes InputOnly InputOutput NormalState TopIf BottomIf WindingRule
  EvenOddRule FillSolid LineSolid CapButt CapRound JoinBevel JoinRound RectangleIn RectangleOut RectanglePart NoValue WidthValue HeightValue "RootWindow(d,s)"
  BadValue BadMatch BadLength GrayScale TrueColor "index(s,c)" "rindex(s,c)")
# In C++ its macros for `move`, `clear`, `erase` and `refresh` are functions, unless one asks for the macros.
set(curses_macros OK ERR "timeout(delay)" "scroll(w)" "border(a,b,c,d,e,f,g,h)" "instr(s)" "inch()" "getch()" "getyx(w,y,x)" "standout()" "scrl(n)" columns lines tab
  bell newline)
set(macros_of_others Q_OBJECT slots signals emit foreach forever nil YES NO MIN MAX ABS CLAMP "major(d)" "minor(d)" "makedev(a,b)" I unix linux B0 ECHO
  DEBUG EPSILON PI EOF SIGN SWAP "check(expression)" "verify(expression)" "ensure(expression)" "require(expression)" "likely(x)" "unlikely(x)")

set(source "// The headers that ours include:\n")
foreach(root IN ITEMS ${include_dir} ${PROJECT_SOURCE_DIR}/device/include)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.hpp)
  list(FILTER found EXCLUDE REGEX "^feeler/adapter/")
  list(TRANSFORM found PREPEND ${root}/)
  if(root STREQUAL include_dir OR FEELER_BUILD_DEVICE)
    list(APPEND headers ${found})
  endif()
endforeach()
foreach(header IN LISTS headers)
  file(STRINGS ${header} lines REGEX "^#include <")
  list(APPEND includes ${lines})
endforeach()
list(REMOVE_DUPLICATES includes)
foreach(line IN LISTS includes)
  string(REGEX REPLACE "^#include (<[^>]*>).*" "#if __has_include(\\1)\n#include \\1\n#endif\n" line "${line}")
  string(APPEND source "${line}")
endforeach()
string(APPEND source "// Macros that no use of their names survives:\n")
foreach(macro IN LISTS windows_macros x11_macros curses_macros macros_of_others)
  string(REGEX MATCH "^[A-Za-z0-9_]+" name "${macro}")
  string(APPEND source "#undef ${name}\n#define ${macro} ]\n")
endforeach()
foreach(header IN LISTS headers)
  string(APPEND source "#include \"${header}\"\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/after_macros.cpp CONTENT "${source}")

# And after the headers of X11 and curses themselves, where they are here; Eigen comes first, as the README says. Those of Windows: test/windows.
set(real_source "")
foreach(line IN LISTS includes)
  if(line MATCHES "<Eigen/")
    string(REGEX REPLACE "^#include (<[^>]*>).*" "#include \\1\n" line "${line}")
    string(APPEND real_source "${line}")
  endif()
endforeach()
foreach(header X11/Xlib.h X11/Xutil.h X11/Xos.h X11/keysym.h curses.h)
  string(APPEND real_source "#if __has_include(<${header}>)\n#include <${header}>\n#endif\n")
endforeach()
foreach(header IN LISTS headers)
  string(APPEND real_source "#include \"${header}\"\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/after_real_headers.cpp CONTENT "${real_source}")
add_library(headers-after-macros OBJECT ${CMAKE_CURRENT_BINARY_DIR}/after_macros.cpp ${CMAKE_CURRENT_BINARY_DIR}/after_real_headers.cpp)
target_link_libraries(headers-after-macros PRIVATE feeler_development feeler::feeler $<TARGET_NAME_IF_EXISTS:feeler::device>)
