#include "pqPointFrontChoice.h"

#include <vtkSMProperty.h>
#include <vtkSMStringListDomain.h>

#include <QComboBox>
#include <QLineEdit>
#include <QVBoxLayout>

pqPointFrontChoice::pqPointFrontChoice(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentWidget)
  : pqPropertyWidget(proxy, parentWidget)
  , List(new QComboBox(this))
{
  this->List->setObjectName("List");
  this->List->setEditable(true);
  this->List->setInsertPolicy(QComboBox::NoInsert);
  this->List->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  this->List->setToolTip(pqPropertyWidget::getTooltip(property));
  auto* const usual = property->FindDomain<vtkSMStringListDomain>();
  for (unsigned int i = 0; usual && i < usual->GetNumberOfStrings(); ++i)
  {
    this->List->addItem(QString::fromUtf8(usual->GetString(i)));
  }
  auto* const layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->List);
  QObject::connect(
    this->List, QOverload<int>::of(&QComboBox::activated), this, &pqPointFrontChoice::take);
  QObject::connect(
    this->List->lineEdit(), &QLineEdit::editingFinished, this, &pqPointFrontChoice::take);
  this->addPropertyLink(this, "value", SIGNAL(valueChanged()), property);
}

pqPointFrontChoice::~pqPointFrontChoice() = default;

QString pqPointFrontChoice::value() const
{
  return this->Value;
}

void pqPointFrontChoice::setValue(const QString& value)
{
  if (value != this->Value)
  {
    this->Value = value;
    this->List->setEditText(value);
    Q_EMIT this->valueChanged();
  }
}

void pqPointFrontChoice::take()
{
  this->setValue(this->List->currentText().trimmed());
}
