/* Unity without a C library; the same on every machine, so that all compute the same. */
#ifndef UNITY_CONFIG_H
#define UNITY_CONFIG_H

void pel_report_character(int character);

#define UNITY_OUTPUT_CHAR(character) pel_report_character(character)
#define UNITY_SUPPORT_64
#define UNITY_EXCLUDE_SETJMP_H
#define UNITY_EXCLUDE_MATH_H
#define UNITY_EXCLUDE_FLOAT
#define UNITY_EXCLUDE_DOUBLE

#endif
