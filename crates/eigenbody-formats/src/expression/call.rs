//! Lists, and calls with their arguments.

use super::{Argument, Call, ExpressionError, Number, Reader, Value};

impl<'a> Reader<'a> {
    /// `name(argument, ..)`.
    pub fn call(&mut self) -> Result<Call<'a>, ExpressionError> {
        let name = self.name()?;
        self.expect('(')?;
        let mut arguments = Vec::new();
        if !self.eat(')') {
            loop {
                arguments.push(self.argument()?);
                if !self.eat(',') {
                    break;
                }
            }
            self.expect(')')?;
        }
        Ok(Call { name, arguments })
    }

    /// A name, passed over.
    fn name(&mut self) -> Result<&'a str, ExpressionError> {
        match self.word() {
            "" => Err(self.unexpected("a name")),
            name => {
                self.skip(name.len());
                Ok(name)
            }
        }
    }

    fn argument(&mut self) -> Result<Argument<'a>, ExpressionError> {
        let offset = self.offset();
        let name = self.word();
        self.skip(name.len());
        let key = (!name.is_empty() && self.eat('=')).then_some(name);
        if key.is_none() {
            self.at = offset;
        }
        Ok(Argument { key, value: self.value()?, offset })
    }

    /// A number or a list.
    pub fn value(&mut self) -> Result<Value, ExpressionError> {
        match self.rest().starts_with('[') {
            true => Ok(Value::List(self.list()?)),
            false => Ok(Value::Number(self.sum()?)),
        }
    }

    /// `[number, ..]`.
    pub fn list(&mut self) -> Result<Vec<Number>, ExpressionError> {
        self.expect('[')?;
        let mut numbers = Vec::new();
        if !self.eat(']') {
            loop {
                let offset = self.offset();
                numbers.push(Number { value: self.number()?, offset });
                if !self.eat(',') {
                    break;
                }
            }
            self.expect(']')?;
        }
        Ok(numbers)
    }
}
