// bielle-mechanism: a model file in, motion out.
