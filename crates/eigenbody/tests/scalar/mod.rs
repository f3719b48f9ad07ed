mod dd;
mod values;
