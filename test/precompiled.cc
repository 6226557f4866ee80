// See core/base/precompiled.cc.
