/* What the lists of arguments.h become in a kernel: parameters, the arguments of a call that passes them on,
 * and the members of a struct. */
#ifndef TRIAD_COMMON_PARAMETERS_H
#define TRIAD_COMMON_PARAMETERS_H

#include "common/language.h"

#include "arguments.h"

#define PARAMETER_FIRST(type, name) global const type* name
#define PARAMETER_ARRAY(type, name) , global const type* name
#define PARAMETER_OWNED(type, name) , global type* restrict name
#define PARAMETER_SHARED(type, name) , volatile global type* name
#define PARAMETER_VALUE(type, name) , type name

#define PARAMETER_FIRST_NAME(type, name) name
#define PARAMETER_NAME(type, name) , name

#define PARAMETER_MEMBER(type, name) global const type* name;

/* Of one of the lists that come after the scene. */
#define PARAMETERS(LIST) LIST(PARAMETER_ARRAY, PARAMETER_OWNED, PARAMETER_SHARED, PARAMETER_VALUE)
#define ARGUMENTS(LIST) LIST(PARAMETER_NAME, PARAMETER_NAME, PARAMETER_NAME, PARAMETER_NAME)

#define SCENE_PARAMETERS SCENE_LIST(PARAMETER_FIRST, PARAMETER_ARRAY)
#define SCENE_ARGUMENTS SCENE_LIST(PARAMETER_FIRST_NAME, PARAMETER_NAME)

#endif
